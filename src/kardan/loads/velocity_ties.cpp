// Rows K v = 0 on the velocities v of the nodes, held by forces F^T lambda on them:
//   v <- v - M^-1 F^T lambda,     (K M^-1 F^T) lambda = K v.
// M holds lumped masses and rotary inertias. K stands in the middle of the coming step and F at its beginning, as in SHAKE (Ryckaert,
// Ciccotti and Berendsen 1977): forces that balance at t_n keep momentum and angular momentum, and a finite rotation carries the
// dependent node with it exactly. For linear equations both are the same. Rows that depend on others are left out.
//
// Interpolation: the rigid motion V + W x (x - c) that is nearest to the velocities v_i of the independent nodes with weights w_i,
//   c = sum w_i x_i / w,   V = sum w_i v_i / w,   W = A^-1 sum w_i r_i x v_i,   A = sum w_i (r_i^2 1 - r_i r_i),   r_i = x_i - c,
// is given to the dependent node at d = x_d - c. Along the axis e its rows are
//   e . v_d - sum [w_i/w e + w_i g x r_i] . v_i = 0,  A g = d x e;        e . w_d - sum w_i (h x r_i) . v_i = 0,  A h = e.
// The forces of a row have no resultant and no moment.
#include "kardan/loads/velocity_ties.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "kardan/state/frames.hpp"

namespace kardan {

namespace {

constexpr int most_sweeps = 20;  ///< to find the middle of the step: each gains a factor of half the step's turn

/// Solves a x = b (n x n, rows first) by elimination with complete pivoting; unknowns without a pivot stay zero.
std::vector<double> solve(std::vector<double> a, std::vector<double> b) {
  const std::size_t n = b.size();
  std::vector<std::size_t> column(n);
  std::iota(column.begin(), column.end(), std::size_t{0});
  double largest = 0;
  std::size_t rank = 0;
  for (; rank < n; ++rank) {
    std::size_t row = rank, col = rank;
    for (std::size_t i = rank; i < n; ++i)
      for (std::size_t j = rank; j < n; ++j)
        if (std::abs(a[i * n + j]) > std::abs(a[row * n + col])) row = i, col = j;
    const double pivot = a[row * n + col];
    largest = std::max(largest, std::abs(pivot));
    if (std::abs(pivot) <= 1e-12 * largest) break;
    for (std::size_t j = 0; j < n; ++j) std::swap(a[rank * n + j], a[row * n + j]);
    std::swap(b[rank], b[row]);
    for (std::size_t i = 0; i < n; ++i) std::swap(a[i * n + rank], a[i * n + col]);
    std::swap(column[rank], column[col]);
    for (std::size_t i = rank + 1; i < n; ++i) {
      const double factor = a[i * n + rank] / pivot;
      for (std::size_t j = rank; j < n; ++j) a[i * n + j] -= factor * a[rank * n + j];
      b[i] -= factor * b[rank];
    }
  }
  std::vector<double> x(n, 0.0);
  for (std::size_t i = rank; i-- > 0;) {
    double sum = b[i];
    for (std::size_t j = i + 1; j < rank; ++j) sum -= a[i * n + j] * x[column[j]];
    x[column[i]] = sum / a[i * n + i];
  }
  return x;
}

/// Weighted centre and second moment A of the independent nodes.
struct Fit {
  double weight = 0;
  Vec3 center;
  Mat3 second_moment;

  Fit(const std::vector<double>& weights, const std::vector<Vec3>& x) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      weight += weights[i];
      center += x[i] * weights[i];
    }
    center = center / weight;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vec3 r = x[i] - center;
      second_moment += (Mat3::identity() * dot(r, r) - outer(r, r)) * weights[i];
    }
  }
  bool flat() const {
    const double size = trace(second_moment) / 3;
    return !(determinant(second_moment) > 1e-9 * size * size * size);
  }
};

}  // namespace

/// Joins ties that share nodes, in the order of the model.
class VelocityTies::Grouping {
 public:
  Grouping(std::vector<Cluster>& clusters, std::size_t nodes) : clusters_(clusters), cluster_of_(nodes, none) {}

  /// The cluster of a tie on these nodes; what it joins is emptied.
  std::size_t join(const std::vector<NodeIndex>& nodes) {
    std::size_t home = clusters_.size();
    for (const NodeIndex n : nodes)
      if (cluster_of_[n] != none) home = std::min(home, static_cast<std::size_t>(cluster_of_[n]));
    if (home == clusters_.size()) clusters_.emplace_back();
    for (const NodeIndex n : nodes) {
      if (cluster_of_[n] == none) {
        clusters_[home].nodes.push_back(n);
        cluster_of_[n] = static_cast<Index>(home);
      } else if (static_cast<std::size_t>(cluster_of_[n]) != home) {
        merge(home, static_cast<std::size_t>(cluster_of_[n]));
      }
    }
    return home;
  }

 private:
  void merge(std::size_t home, std::size_t other) {
    for (const NodeIndex n : clusters_[other].nodes) cluster_of_[n] = static_cast<Index>(home);
    const auto move = [&](auto list) {
      auto& from = clusters_[other].*list;
      auto& to = clusters_[home].*list;
      to.insert(to.end(), from.begin(), from.end());
      from.clear();
    };
    move(&Cluster::nodes);
    move(&Cluster::equations);
    move(&Cluster::interpolations);
  }

  std::vector<Cluster>& clusters_;
  std::vector<Index> cluster_of_;
};

VelocityTies::VelocityTies(const Model& model, State& state, TakenDofs& taken, Diagnostics& diagnostics) {
  if (model.linear_equations.empty() && model.interpolations.empty()) return;
  Grouping grouping(clusters_, model.nodes.size());
  const TakenDofs held = taken;
  const auto refuse_held = [&](NodeIndex n, std::uint8_t dofs, const std::string& what, const char* keyword) {
    held.check(model, state, n, dofs, what, keyword, diagnostics);  // ties of this kind may share nodes
  };
  const auto nodes_of = [](const LinearEquation& equation) {
    std::vector<NodeIndex> nodes;
    for (const LinearEquation::Term& t : equation.terms) nodes.push_back(t.node);
    return nodes;
  };
  for (std::size_t i = 0; i < model.linear_equations.size(); ++i) {
    const LinearEquation& equation = model.linear_equations[i];
    for (const LinearEquation::Term& t : equation.terms) {
      need_frame(model, state, t.frame);
      const bool angular = t.dof > 3;
      const std::uint8_t all = angular ? dof_rotations : dof_translations;
      refuse_held(t.node, t.frame == none ? static_cast<std::uint8_t>(1u << (t.dof - 1)) : all,
                  "linear constraint " + std::to_string(equation.id), "*CONSTRAINED_LINEAR");
      if (angular && state.nodes.inertia[t.node] <= 0)
        diagnostics.error("node " + std::to_string(model.nodes.id[t.node]) + " of linear constraint " + std::to_string(equation.id) +
                              " has no rotary inertia", "constrain rotations of shell nodes only", "*CONSTRAINED_LINEAR");
    }
    clusters_[grouping.join(nodes_of(equation))].equations.push_back(static_cast<Index>(i));
  }
  for (std::size_t i = 0; i < model.interpolations.size(); ++i) {
    const Interpolation& tie = model.interpolations[i];
    const std::string name = "interpolation " + std::to_string(tie.id);
    need_frame(model, state, tie.frame);
    // In local axes a translation takes part of all three.
    const auto in_global = [&](std::uint8_t all) { return (tie.dofs & all) == 0 || tie.frame == none ? tie.dofs & all : all; };
    const auto dofs = static_cast<std::uint8_t>(in_global(dof_translations) | in_global(dof_rotations));
    taken.take(model, state, tie.dependent, dofs, name, "*CONSTRAINED_INTERPOLATION", diagnostics);
    std::vector<Vec3> x;
    for (const NodeIndex n : tie.nodes) {
      refuse_held(n, dof_translations, name, "*CONSTRAINED_INTERPOLATION");
      x.push_back(state.nodes.x[n]);
    }
    const auto turns = [&](NodeIndex n) { return state.nodes.inertia[n] > 0; };
    if (tie.asks_rotations && std::any_of(tie.nodes.begin(), tie.nodes.end(), turns))
      diagnostics.warning(name + ": the rotations of independent nodes (IDOF 456) take no part; the motion is that of their translations",
                          "give IDOF = 123 where that is meant", "*CONSTRAINED_INTERPOLATION");
    if (Fit(tie.weight, x).flat())
      diagnostics.error("the independent nodes of " + name + " stand on one line: the rotation about it is not determined",
                        "add a node off the line", "*CONSTRAINED_INTERPOLATION");
    std::vector<NodeIndex> nodes{tie.dependent};
    nodes.insert(nodes.end(), tie.nodes.begin(), tie.nodes.end());
    clusters_[grouping.join(nodes)].interpolations.push_back(static_cast<Index>(i));
  }
  std::erase_if(clusters_, [](const Cluster& c) { return c.nodes.empty(); });
  std::vector<std::size_t> place(model.nodes.size(), 0);
  for (Cluster& cluster : clusters_) {
    for (std::size_t k = 0; k < cluster.nodes.size(); ++k) place[cluster.nodes[k]] = k;
    for (const Index i : cluster.interpolations) {
      auto& places = cluster.places.emplace_back(1, place[model.interpolations[i].dependent]);
      for (const NodeIndex n : model.interpolations[i].nodes) places.push_back(place[n]);
    }
    for (const Index i : cluster.equations) {
      auto& places = cluster.equation_places.emplace_back();
      for (const LinearEquation::Term& t : model.linear_equations[i].terms) places.push_back(place[t.node]);
    }
  }
}

void VelocityTies::add_equations(const Model& model, const State& state, const Cluster& cluster, std::vector<Row>& rows) const {
  for (std::size_t i = 0; i < cluster.equations.size(); ++i) {
    const LinearEquation& equation = model.linear_equations[cluster.equations[i]];
    Row& row = rows.emplace_back();
    for (std::size_t k = 0; k < equation.terms.size(); ++k) {
      const LinearEquation::Term& t = equation.terms[k];
      const Vec3 along = frame_axes(model, state, t.frame).column(static_cast<std::size_t>(t.dof - 1) % 3) * t.coefficient;
      row.push_back({cluster.equation_places[i][k], t.dof <= 3 ? along : Vec3{}, t.dof <= 3 ? Vec3{} : along});
    }
  }
}

void VelocityTies::add_interpolations(const Model& model, const State& state, const Cluster& cluster, const std::vector<Vec3>& x,
                                      std::vector<Row>& rows) const {
  for (std::size_t i = 0; i < cluster.interpolations.size(); ++i) {
    const Interpolation& tie = model.interpolations[cluster.interpolations[i]];
    const auto& places = cluster.places[i];
    std::vector<Vec3> independent;
    for (std::size_t k = 1; k < places.size(); ++k) independent.push_back(x[places[k]]);
    const Fit fit(tie.weight, independent);
    const Mat3 inverse_moment = inverse(fit.second_moment);
    const Vec3 d = x[places[0]] - fit.center;
    for (std::size_t dof = 0; dof < 6; ++dof) {
      if (!(tie.dofs & (1u << dof))) continue;
      const bool angular = dof >= 3;
      const Vec3 e = frame_axes(model, state, tie.frame).column(dof % 3), g = inverse_moment * (angular ? e : cross(d, e));
      Row& row = rows.emplace_back();
      row.push_back({places[0], angular ? Vec3{} : e, angular ? e : Vec3{}});
      for (std::size_t k = 0; k < independent.size(); ++k) {
        const Vec3 mean = angular ? Vec3{} : e / fit.weight;
        row.push_back({places[k + 1], -(mean + cross(g, independent[k] - fit.center)) * tie.weight[k], {}});
      }
    }
  }
}

void VelocityTies::impose(const Model& model, State& state, const Cluster& cluster) const {
  NodeState& nodes = state.nodes;
  const std::size_t count = cluster.nodes.size();
  std::vector<Vec3> x(count), v(count), omega(count);
  for (std::size_t k = 0; k < count; ++k) {
    x[k] = nodes.x[cluster.nodes[k]];
    v[k] = nodes.v[cluster.nodes[k]];
    omega[k] = nodes.omega[cluster.nodes[k]];
  }
  std::vector<Row> forces;
  add_equations(model, state, cluster, forces);
  const std::vector<Row> equations = forces;
  add_interpolations(model, state, cluster, x, forces);
  const std::size_t rows = forces.size();
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const std::vector<Vec3> v_before = v;
    std::vector<Vec3> middle(count);
    for (std::size_t k = 0; k < count; ++k) middle[k] = x[k] + v[k] * (0.5 * state.clock.dt);
    std::vector<Row> kinematic = equations;
    add_interpolations(model, state, cluster, middle, kinematic);
    std::vector<double> matrix(rows * rows, 0.0), rate(rows, 0.0);
    for (std::size_t j = 0; j < rows; ++j) {
      std::vector<Vec3> dv(count), domega(count);  // response of the nodes to a unit of row j
      for (const Term& t : forces[j]) {
        const NodeIndex n = cluster.nodes[t.node];
        dv[t.node] += t.linear / nodes.mass[n];
        if (nodes.inertia[n] > 0) domega[t.node] += t.angular / nodes.inertia[n];
      }
      for (std::size_t i = 0; i < rows; ++i)
        for (const Term& t : kinematic[i]) matrix[i * rows + j] += dot(t.linear, dv[t.node]) + dot(t.angular, domega[t.node]);
      for (const Term& t : kinematic[j]) rate[j] += dot(t.linear, v[t.node]) + dot(t.angular, omega[t.node]);
    }
    const std::vector<double> impulse = solve(std::move(matrix), std::move(rate));
    for (std::size_t j = 0; j < rows; ++j) {
      for (const Term& t : forces[j]) {
        const NodeIndex n = cluster.nodes[t.node];
        v[t.node] -= t.linear * (impulse[j] / nodes.mass[n]);
        if (nodes.inertia[n] > 0) omega[t.node] -= t.angular * (impulse[j] / nodes.inertia[n]);
      }
    }
    if (cluster.interpolations.empty()) break;
    double change = 0, size = 0;
    for (std::size_t k = 0; k < count; ++k) {
      change = std::max(change, norm(v[k] - v_before[k]));
      size = std::max(size, norm(v[k]));
    }
    if (change <= 1e-14 * size) break;
  }
  for (std::size_t k = 0; k < count; ++k) {
    nodes.v[cluster.nodes[k]] = v[k];
    nodes.omega[cluster.nodes[k]] = omega[k];
  }
}

void VelocityTies::impose(const Model& model, State& state) const {
  for (const Cluster& cluster : clusters_) impose(model, state, cluster);
}

}  // namespace kardan
