// What is measured on a run: named quantities of the state at t_n, as case.json describes them.
#pragma once

#include <functional>
#include <vector>

#include <nlohmann/json.hpp>

#include "kardan/model/model.hpp"
#include "kardan/state/state.hpp"

namespace kardan::verify {

/// Evaluates one signal on the state at t_n. A signal that counts turns keeps its last angle, so it is to be called in
/// the order of time.
using Signal = std::function<std::vector<double>(const State&)>;

/// Makes a signal of its description:
///
///   {"body": part, "quantity": Q}      Q: center, displacement, velocity, acceleration, angular_velocity,
///                                      angular_acceleration, angular_momentum (half step, about the centre),
///                                      body_angular_velocity (axes that turn with the body, global at t = 0),
///                                      quaternion ("initial": that of t = 0, default 1, 0, 0, 0),
///                                      turn ("axis": angle about a fixed axis, counted over full turns),
///                                      carried_point ("point": global coordinates at t = 0; moves with the body)
///                                      mass
///   {"relative": [a, b], "quantity": Q}  of body b in axes that turn with body a (global at t = 0):
///                                      displacement ("point": where it was common at t = 0), rotation (vector),
///                                      direction ("direction": of t = 0, carried by b)
///   {"node": id, "quantity": Q}        position, displacement, velocity, acceleration
///   {"solid": id, "quantity": "stress"}  xx, yy, zz, xy, yz, zx, global axes; of deformable solids
///   {"joint": id, "quantity": Q}       force, moment (of body A on body B), separation, angular_separation, energy
///   {"joint": "all", "quantity": Q}    the largest of all joints; separation, angular_separation
///   {"stiffness": id, "quantity": Q}   coordinate, rate, elastic, damping, total (three components), energy
///   {"contact": id, "quantity": Q}     force (on the tracked side), friction_energy
///   {"wall": id, "quantity": "force"}  of the nodes on a rigid wall
///   {"part": id, "quantity": Q}        momentum, angular_momentum (about the origin): of the nodes of its shells and solids
///   {"energy": name}                   total, kinetic, internal, hourglass, spring_damper, joint, sliding, external_work, ratio,
///                                      balance (total - external work), initial_joint_loss
///   {"momentum": Q}                    linear, angular (of all bodies about the origin, half step)
///   {"sum": [signals]}                 componentwise
///   {"join": [signals]}                all components one after the other
///   {"quotient": [a, b]}               a / b, scalars
///
/// and, in this order, "along": [x, y, z] (scalar product), "components": [i, …], "norm": true, "factor": f, "offset":
/// o.
/// @throws CaseError if it is not understood or names something that the model has not.
Signal make_signal(const nlohmann::json& description, const Model& model, const State& state);

}  // namespace kardan::verify
