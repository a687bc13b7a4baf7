#include "kardan/contact/motion_meter.hpp"

#include <algorithm>
#include <cmath>

namespace kardan {

namespace {

/// Nodes of rigid bodies move on arcs: within a step (at most half a radian) by a little more than v dt.
constexpr double arc = 1.1;
constexpr std::ptrdiff_t parallel_nodes = 4'000;

}  // namespace

void MotionMeter::renew(const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  x_.resize(nodes_.size());
  velocity_ = shift_ = {};
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    x_[i] = x[nodes_[i]];
    velocity_ += v[nodes_[i]];
  }
  if (!nodes_.empty()) velocity_ *= 1 / static_cast<double>(nodes_.size());
  checked_way_ = 0;
  checked_travel_ = travel_;
}

void MotionMeter::advance(const std::vector<Vec3>& v, double dt) {
  double largest = 0;
  const auto count = static_cast<std::ptrdiff_t>(nodes_.size());
#pragma omp parallel for schedule(static) reduction(max : largest) if (count > parallel_nodes)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Vec3 r = v[nodes_[i]] - velocity_;
    largest = std::max(largest, dot(r, r));
  }
  last_travel_ = arc * std::sqrt(largest) * dt;
  travel_ += last_travel_;
  shift_ += velocity_ * dt;
}

bool MotionMeter::exceeds(double way, const std::vector<Vec3>& x) {
  if (checked_way_ + travel_ - checked_travel_ <= way) return false;
  double largest = 0;
  const auto count = static_cast<std::ptrdiff_t>(nodes_.size());
#pragma omp parallel for schedule(static) reduction(max : largest) if (count > parallel_nodes)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const Vec3 r = x[nodes_[n]] - x_[n] - shift_;
    largest = std::max(largest, dot(r, r));
  }
  checked_way_ = std::sqrt(largest);
  checked_travel_ = travel_;
  return checked_way_ > way;
}

}  // namespace kardan
