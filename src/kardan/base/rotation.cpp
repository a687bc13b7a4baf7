#include "kardan/base/rotation.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace kardan {

Quat from_matrix(const Mat3& r) {
  const double t = trace(r);
  const std::array<double, 4> d{t, r[0][0], r[1][1], r[2][2]};
  const auto k = std::distance(d.begin(), std::max_element(d.begin(), d.end()));
  Quat q;
  if (k == 0) {
    q = {1 + t, r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]};
  } else if (k == 1) {
    q = {r[2][1] - r[1][2], 1 + 2 * r[0][0] - t, r[0][1] + r[1][0], r[0][2] + r[2][0]};
  } else if (k == 2) {
    q = {r[0][2] - r[2][0], r[0][1] + r[1][0], 1 + 2 * r[1][1] - t, r[1][2] + r[2][1]};
  } else {
    q = {r[1][0] - r[0][1], r[0][2] + r[2][0], r[1][2] + r[2][1], 1 + 2 * r[2][2] - t};
  }
  return normalized(q);
}

Quat from_rotation_vector(const Vec3& theta) {
  const double angle = norm(theta);
  if (angle < 1e-8) return normalized(Quat{1, 0.5 * theta.x, 0.5 * theta.y, 0.5 * theta.z});
  const double s = std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * theta.x, s * theta.y, s * theta.z};
}

Vec3 to_rotation_vector(const Quat& q) {
  const double sign = q.w < 0 ? -1.0 : 1.0;
  const Vec3 v = q.vec() * sign;
  const double s = norm(v);
  if (s < 1e-8) return v * 2.0;
  return v * (2.0 * std::atan2(s, q.w * sign) / s);
}

PrincipalAxes principal_axes(const Mat3& symmetric) {
  Mat3 a = symmetric;
  Mat3 v = Mat3::identity();
  for (int sweep = 0; sweep < 50; ++sweep) {
    const double off = std::abs(a[0][1]) + std::abs(a[0][2]) + std::abs(a[1][2]);
    const double diag = std::abs(a[0][0]) + std::abs(a[1][1]) + std::abs(a[2][2]);
    if (off <= 1e-300 || off <= 1e-17 * diag) break;
    for (auto [p, q] : {std::pair<int, int>{0, 1}, {0, 2}, {1, 2}}) {
      if (a[p][q] == 0) continue;
      const double h = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = (h >= 0 ? 1.0 : -1.0) / (std::abs(h) + std::sqrt(h * h + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      for (int k = 0; k < 3; ++k) {
        const double akp = a[k][p], akq = a[k][q];
        a[k][p] = c * akp - s * akq;
        a[k][q] = s * akp + c * akq;
      }
      for (int k = 0; k < 3; ++k) {
        const double apk = a[p][k], aqk = a[q][k];
        a[p][k] = c * apk - s * aqk;
        a[q][k] = s * apk + c * aqk;
        const double vkp = v[k][p], vkq = v[k][q];
        v[k][p] = c * vkp - s * vkq;
        v[k][q] = s * vkp + c * vkq;
      }
    }
  }
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return a[i][i] < a[j][j]; });
  PrincipalAxes result;
  const Vec3 e0 = v.column(order[0]), e1 = v.column(order[1]);
  result.values = {a[order[0]][order[0]], a[order[1]][order[1]], a[order[2]][order[2]]};
  result.axes = Mat3::columns(e0, e1, cross(e0, e1));
  return result;
}

}  // namespace kardan
