#include "kardan/contact/motion_meter.hpp"

#include <algorithm>
#include <cmath>

#include "kardan/parallel/exchange.hpp"

namespace kardan {

namespace {

/// Nodes of rigid bodies move on arcs: within a step (at most half a radian) by a little more than v dt.
constexpr double arc = 1.1;
constexpr std::ptrdiff_t parallel_nodes = 4'000;

/// Largest of f(i) for i < count, and 0. Four side by side, because a maximum waits for the one before.
template <class F>
double largest_of(std::size_t count, F&& f) {
  double largest = 0;
  const auto fours = static_cast<std::ptrdiff_t>(count / 4);
#pragma omp parallel if (4 * fours > parallel_nodes) reduction(max : largest)
  {
    double most[4] = {};
#pragma omp for schedule(static) nowait
    for (std::ptrdiff_t i = 0; i < fours; ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        const double value = f(static_cast<std::size_t>(4 * i) + k);
        most[k] = most[k] < value ? value : most[k];
      }
    largest = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
  }
  for (std::size_t n = count / 4 * 4; n < count; ++n) largest = std::max(largest, f(n));
  return largest;
}

}  // namespace

void MotionMeter::renew(const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  x_.resize(nodes_.size());
  const Pieces pieces(nodes_.size(), 4096);
  std::vector<Vec3> sums(pieces.count());
  for_each_piece(pieces, [&](std::size_t piece, std::size_t begin, std::size_t end) {
    Vec3 sum;
    for (std::size_t i = begin; i < end; ++i) {
      x_[i] = x[nodes_[i]];
      sum += v[nodes_[i]];
    }
    sums[piece] = sum;
  });
  velocity_ = shift_ = {};
  for (const Vec3& sum : sums) velocity_ += sum;
  if (!nodes_.empty()) velocity_ *= 1 / static_cast<double>(nodes_.size());
  travel_ = checked_way_ = checked_travel_ = 0;
}

void MotionMeter::register_state(Registry& registry, const std::string& name) {
  const std::string writer = "contacts.apply";
  registry.keep_list({name + ".nodes", "1", "contacts.drop_deleted"}, nodes_);
  registry.keep_list({name + ".x", "length", writer}, x_);
  registry.keep_value({name + ".velocity", "length/time", writer}, velocity_);
  registry.keep_value({name + ".shift", "length", writer}, shift_);
  registry.keep_value({name + ".travel", "length", writer}, travel_);
  registry.keep_value({name + ".last_travel", "length", writer}, last_travel_);
  registry.keep_value({name + ".checked_way", "length", writer}, checked_way_);
  registry.keep_value({name + ".checked_travel", "length", writer}, checked_travel_);
}

void MotionMeter::advance(const std::vector<Vec3>& v, double dt) {
  const double largest = largest_of(nodes_.size(), [nodes = nodes_.data(), v = v.data(), mean = velocity_](std::size_t i) {
    const Vec3 r = v[nodes[i]] - mean;
    return dot(r, r);
  });
  last_travel_ = arc * std::sqrt(largest) * dt;
  travel_ += last_travel_;
  shift_ += velocity_ * dt;
}

bool MotionMeter::exceeds(double way, const std::vector<Vec3>& x) {
  if (checked_way_ + travel_ - checked_travel_ <= way) return false;
  const double largest = largest_of(nodes_.size(), [&](std::size_t i) {
    const Vec3 r = x[nodes_[i]] - x_[i] - shift_;
    return dot(r, r);
  });
  checked_way_ = std::sqrt(largest);
  checked_travel_ = travel_;
  return checked_way_ > way;
}

}  // namespace kardan
