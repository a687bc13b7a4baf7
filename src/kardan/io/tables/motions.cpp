// NODOUT and RBDOUT.
#include <algorithm>

#include "kardan/io/tables/reporter.hpp"

namespace kardan {

Folder nodout_folder(const Model& model, const State& state, const BodyFrames& frames) {
  const std::vector<NodeIndex>& nodes = model.output.history_nodes;
  const NodeState& s = state.nodes;
  Folder f;
  f.path = "/nodout";
  IntegerColumn ids{"ids", {}};
  for (const NodeIndex n : nodes) ids.values.push_back(model.nodes.id[static_cast<std::size_t>(n)]);
  f.metadata.push_back(std::move(ids));
  f.integers = {{"cycle", {state.clock.cycle}}};
  const auto node = [&](std::size_t i) { return static_cast<std::size_t>(nodes[i]); };
  const auto body = [&](std::size_t i) { return s.body[node(i)]; };
  const auto report = [&](std::size_t i) -> const BodyReport& {
    return state.bodies.report[static_cast<std::size_t>(body(i))];
  };
  const std::size_t n = nodes.size();
  f.add_vectors("x_displacement", "y_displacement", "z_displacement", n,
                [&](std::size_t i) { return s.x[node(i)] - model.nodes.x[node(i)]; });
  f.add_vectors("x_velocity", "y_velocity", "z_velocity", n, [&](std::size_t i) { return s.v_now[node(i)]; });
  f.add_vectors("x_acceleration", "y_acceleration", "z_acceleration", n, [&](std::size_t i) { return s.a[node(i)]; });
  f.add_vectors("x_coordinate", "y_coordinate", "z_coordinate", n, [&](std::size_t i) { return s.x[node(i)]; });
  f.add_vectors("rx_displacement", "ry_displacement", "rz_displacement", n,
                [&](std::size_t i) { return body(i) == none ? Vec3{} : frames.rotation(body(i)); });
  f.add_vectors("rx_velocity", "ry_velocity", "rz_velocity", n,
                [&](std::size_t i) { return body(i) == none ? s.omega_now[node(i)] : report(i).angular_velocity; });
  f.add_vectors("rx_acceleration", "ry_acceleration", "rz_acceleration", n,
                [&](std::size_t i) { return body(i) == none ? s.alpha[node(i)] : report(i).angular_acceleration; });
  return f;
}

Folder rbdout_folder(const Model&, const State& state, const BodyFrames& frames) {
  const BodyState& bodies = state.bodies;
  std::vector<std::size_t> order;  // nodal rigid bodies come last, as num_nodal says
  for (const bool nodal : {false, true})
    for (std::size_t b = 0; b < bodies.info.size(); ++b)
      if (bodies.info[b].nodal == nodal) order.push_back(b);
  Folder f;
  f.path = "/rbdout";
  IntegerColumn ids{"ids", {}};
  for (const std::size_t b : order) ids.values.push_back(bodies.info[b].id);
  const auto nodal = std::count_if(order.begin(), order.end(), [&](std::size_t b) { return bodies.info[b].nodal; });
  f.metadata = {std::move(ids), {"num_nodal", {static_cast<std::int64_t>(nodal)}}};
  f.integers = {{"cycle", {state.clock.cycle}}};

  const std::size_t n = order.size();
  std::vector<Mat3> axes(n);
  for (std::size_t i = 0; i < n; ++i) axes[i] = frames.axes(state, static_cast<BodyIndex>(order[i]));
  const auto report = [&](std::size_t i) -> const BodyReport& { return bodies.report[order[i]]; };
  const auto displacement = [&](std::size_t i) {
    return bodies.motion[order[i]].center - bodies.info[order[i]].initial_center;
  };
  const auto rotation = [&](std::size_t i) { return frames.rotation(static_cast<BodyIndex>(order[i])); };
  const auto velocity = [&](std::size_t i) { return report(i).velocity; };
  const auto spin = [&](std::size_t i) { return report(i).angular_velocity; };
  const auto acceleration = [&](std::size_t i) { return report(i).acceleration; };
  const auto spin_up = [&](std::size_t i) { return report(i).angular_acceleration; };
  const auto local = [&](auto&& value) { return [&](std::size_t i) { return transpose(axes[i]) * value(i); }; };

  f.add_vectors("global_x", "global_y", "global_z", n, [&](std::size_t i) { return bodies.motion[order[i]].center; });
  f.add_vectors("global_dx", "global_dy", "global_dz", n, displacement);
  f.add_vectors("global_rdx", "global_rdy", "global_rdz", n, rotation);
  f.add_vectors("global_vx", "global_vy", "global_vz", n, velocity);
  f.add_vectors("global_rvx", "global_rvy", "global_rvz", n, spin);
  f.add_vectors("global_ax", "global_ay", "global_az", n, acceleration);
  f.add_vectors("global_rax", "global_ray", "global_raz", n, spin_up);
  f.add_vectors("dircos_11", "dircos_12", "dircos_13", n, [&](std::size_t i) { return axes[i][0]; });
  f.add_vectors("dircos_21", "dircos_22", "dircos_23", n, [&](std::size_t i) { return axes[i][1]; });
  f.add_vectors("dircos_31", "dircos_32", "dircos_33", n, [&](std::size_t i) { return axes[i][2]; });
  f.add_vectors("local_dx", "local_dy", "local_dz", n, local(displacement));
  f.add_vectors("local_rdx", "local_rdy", "local_rdz", n, local(rotation));
  f.add_vectors("local_vx", "local_vy", "local_vz", n, local(velocity));
  f.add_vectors("local_rvx", "local_rvy", "local_rvz", n, local(spin));
  f.add_vectors("local_ax", "local_ay", "local_az", n, local(acceleration));
  f.add_vectors("local_rax", "local_ray", "local_raz", n, local(spin_up));
  return f;
}

}  // namespace kardan
