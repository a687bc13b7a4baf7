#include "kardan/app/verify/signal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "kardan/app/verify/series.hpp"
#include "kardan/base/rotation.hpp"

namespace kardan::verify {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const json& description, const std::string& why) {
  throw CaseError("signal " + description.dump() + ": " + why);
}

std::vector<double> components(const Vec3& v) {
  return {v.x, v.y, v.z};
}
std::vector<double> components(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

Vec3 vector_of(const json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

std::size_t body_index(const json& d, const json& id_entry, const State& state) {
  const auto id = id_entry.get<UserId>();
  const auto& info = state.bodies.info;
  const auto found = std::find_if(info.begin(), info.end(), [&](const BodyInfo& b) { return b.id == id; });
  if (found == info.end()) refuse(d, "no rigid body " + std::to_string(id));
  return static_cast<std::size_t>(found - info.begin());
}

/// Rotation of the body since t = 0, in global axes.
Quat turned(const BodyState& bodies, std::size_t b) {
  return bodies.motion[b].orientation * conjugate(bodies.info[b].initial_orientation);
}

/// Global position at t_n of the point of body b that was at `point` at t = 0.
Vec3 carried(const BodyState& bodies, std::size_t b, const Vec3& point) {
  return bodies.motion[b].center + to_matrix(turned(bodies, b)) * (point - bodies.info[b].initial_center);
}

/// Angle of the rotation since t = 0 about a fixed axis (swing-twist), continued over full turns.
Signal turn_signal(std::size_t b, const Vec3& axis) {
  return [b, axis, last = std::make_shared<double>(0.0)](const State& s) {
    const Quat q = turned(s.bodies, b);
    const double angle = 2 * std::atan2(dot(q.vec(), axis), q.w), full = 2 * std::numbers::pi;
    *last = angle + full * std::round((*last - angle) / full);
    return std::vector{*last};
  };
}

Signal body_signal(const json& d, const State& state) {
  const std::size_t b = body_index(d, d.at("body"), state);
  const auto quantity = d.at("quantity").get<std::string>();
  const auto of_motion = [b](Vec3 BodyMotion::*m) {
    return [b, m](const State& s) { return components(s.bodies.motion[b].*m); };
  };
  const auto of_report = [b](Vec3 BodyReport::*m) {
    return [b, m](const State& s) { return components(s.bodies.report[b].*m); };
  };
  if (quantity == "center") return of_motion(&BodyMotion::center);
  if (quantity == "velocity") return of_report(&BodyReport::velocity);
  if (quantity == "acceleration") return of_report(&BodyReport::acceleration);
  if (quantity == "angular_velocity") return of_report(&BodyReport::angular_velocity);
  if (quantity == "angular_acceleration") return of_report(&BodyReport::angular_acceleration);
  if (quantity == "angular_momentum") return of_motion(&BodyMotion::angular_momentum);
  if (quantity == "mass") return [b](const State& s) { return std::vector{s.bodies.info[b].mass}; };
  if (quantity == "displacement")
    return [b](const State& s) { return components(s.bodies.motion[b].center - s.bodies.info[b].initial_center); };
  if (quantity == "body_angular_velocity")
    return [b](const State& s) {
      return components(transpose(to_matrix(turned(s.bodies, b))) * s.bodies.report[b].angular_velocity);
    };
  if (quantity == "turn") return turn_signal(b, normalized(vector_of(d.at("axis"))));
  if (quantity == "carried_point")
    return [b, point = vector_of(d.at("point"))](const State& s) { return components(carried(s.bodies, b, point)); };
  if (quantity == "quaternion") {
    Quat start;
    if (d.contains("initial")) {
      const json& q = d["initial"];
      start =
          normalized(Quat{q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(), q.at(3).get<double>()});
    }
    return [b, start](const State& s) {
      const Quat q = turned(s.bodies, b) * start;
      return std::vector{q.w, q.x, q.y, q.z};
    };
  }
  refuse(d, "no such quantity of a body");
}

Signal relative_signal(const json& d, const State& state) {
  const std::size_t a = body_index(d, d.at("relative").at(0), state), b = body_index(d, d.at("relative").at(1), state);
  const auto quantity = d.at("quantity").get<std::string>();
  if (quantity == "displacement")
    return [a, b, point = vector_of(d.at("point"))](const State& s) {
      const Vec3 gap = carried(s.bodies, b, point) - carried(s.bodies, a, point);
      return components(transpose(to_matrix(turned(s.bodies, a))) * gap);
    };
  if (quantity == "rotation")
    return [a, b](const State& s) {
      return components(to_rotation_vector(conjugate(turned(s.bodies, a)) * turned(s.bodies, b)));
    };
  if (quantity == "direction")
    return [a, b, direction = vector_of(d.at("direction"))](const State& s) {
      return components(to_matrix(conjugate(turned(s.bodies, a)) * turned(s.bodies, b)) * direction);
    };
  refuse(d, "no such quantity of a pair of bodies");
}

Signal node_signal(const json& d, const Model& model) {
  const Index found = model.nodes.index_of.index(d.at("node").get<UserId>());
  if (found == none) refuse(d, "no such node");
  const auto n = static_cast<std::size_t>(found);
  const auto quantity = d.at("quantity").get<std::string>();
  if (quantity == "position") return [n](const State& s) { return components(s.nodes.x[n]); };
  if (quantity == "displacement")
    return [n, start = model.nodes.x[n]](const State& s) { return components(s.nodes.x[n] - start); };
  if (quantity == "velocity") return [n](const State& s) { return components(s.nodes.v_now[n]); };
  if (quantity == "acceleration") return [n](const State& s) { return components(s.nodes.a[n]); };
  refuse(d, "no such quantity of a node");
}

Signal solid_signal(const json& d, const Model& model, const State& state) {
  const auto& ids = model.solids.id;
  const auto found = std::find(ids.begin(), ids.end(), d.at("solid").get<UserId>());
  if (found == ids.end()) refuse(d, "no such solid");
  if (d.at("quantity") != "stress") refuse(d, "no such quantity of a solid");
  if (state.results.solid.stress.empty()) refuse(d, "no solid of the model deforms");
  return [e = static_cast<std::size_t>(found - ids.begin())](const State& s) {
    const StressVector& stress = s.results.solid.stress[e];
    return std::vector<double>(stress.begin(), stress.end());
  };
}

template <class Item>
std::size_t index_by_id(const json& d, const char* key, const std::vector<Item>& items) {
  const auto id = d.at(key).get<UserId>();
  const auto found = std::find_if(items.begin(), items.end(), [&](const Item& i) { return i.id == id; });
  if (found == items.end()) refuse(d, std::string("no ") + key + " " + std::to_string(id));
  return static_cast<std::size_t>(found - items.begin());
}

Signal joint_signal(const json& d, const Model& model) {
  const auto quantity = d.at("quantity").get<std::string>();
  double JointReport::*scalar = quantity == "separation"           ? &JointReport::separation
                                : quantity == "angular_separation" ? &JointReport::angular_separation
                                : quantity == "energy"             ? &JointReport::energy
                                                                   : nullptr;
  if (d.at("joint") == "all") {
    if (!scalar) refuse(d, "\"all\" goes with separation, angular_separation and energy");
    return [scalar](const State& s) {
      double largest = 0;
      for (const JointReport& j : s.joints) largest = std::max(largest, j.*scalar);
      return std::vector{largest};
    };
  }
  const std::size_t j = index_by_id(d, "joint", model.joints);
  if (scalar) return [j, scalar](const State& s) { return std::vector{s.joints[j].*scalar}; };
  if (quantity == "force") return [j](const State& s) { return components(s.joints[j].force); };
  if (quantity == "moment") return [j](const State& s) { return components(s.joints[j].moment); };
  refuse(d, "no such quantity of a joint");
}

Signal stiffness_signal(const json& d, const Model& model) {
  const std::size_t j = index_by_id(d, "stiffness", model.joint_stiffnesses);
  const auto quantity = d.at("quantity").get<std::string>();
  const auto of = [j](std::array<double, 3> JointStiffnessReport::*m) {
    return [j, m](const State& s) { return components(s.joint_stiffnesses[j].*m); };
  };
  if (quantity == "coordinate") return of(&JointStiffnessReport::coordinate);
  if (quantity == "rate") return of(&JointStiffnessReport::rate);
  if (quantity == "elastic") return of(&JointStiffnessReport::elastic);
  if (quantity == "damping") return of(&JointStiffnessReport::damping);
  if (quantity == "total") return of(&JointStiffnessReport::total);
  if (quantity == "energy") return [j](const State& s) { return std::vector{s.joint_stiffnesses[j].energy}; };
  refuse(d, "no such quantity of a joint stiffness");
}

Signal contact_signal(const json& d, const Model& model) {
  const std::size_t c = index_by_id(d, "contact", model.contacts);
  const auto quantity = d.at("quantity").get<std::string>();
  if (quantity == "force") return [c](const State& s) { return components(s.contacts[c].force); };
  if (quantity == "friction_energy") return [c](const State& s) { return std::vector{s.contacts[c].friction_energy}; };
  refuse(d, "no such quantity of a contact");
}

Signal wall_signal(const json& d, const Model& model) {
  const std::size_t w = index_by_id(d, "wall", model.rigid_walls);
  if (d.at("quantity") != "force") refuse(d, "no such quantity of a rigid wall");
  return [w](const State& s) { return components(s.walls[w].force); };
}

/// Nodes of the part's shells and solids.
std::vector<NodeIndex> nodes_of(const Model& model, std::size_t part) {
  std::vector<NodeIndex> nodes;
  const auto add = [&](const auto& elements) {
    for (std::size_t e = 0; e < elements.part.size(); ++e)
      if (elements.part[e] == static_cast<PartIndex>(part)) nodes.insert(nodes.end(), elements.nodes[e].begin(), elements.nodes[e].end());
  };
  add(model.shells);
  add(model.solids);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Signal part_signal(const json& d, const Model& model) {
  const auto nodes = nodes_of(model, index_by_id(d, "part", model.parts));
  if (nodes.empty()) refuse(d, "the part has no shells and no solids");
  const auto sum = [nodes](const auto& of_node) {
    return [nodes, of_node](const State& s) {
      Vec3 total{};
      for (const NodeIndex n : nodes) total += of_node(s.nodes, static_cast<std::size_t>(n));
      return components(total);
    };
  };
  const auto quantity = d.at("quantity").get<std::string>();
  if (quantity == "momentum") return sum([](const auto& all, std::size_t n) { return all.mass[n] * all.v_now[n]; });
  if (quantity == "angular_momentum")
    return sum([](const auto& all, std::size_t n) {
      return cross(all.x[n], all.mass[n] * all.v_now[n]) + all.inertia[n] * all.omega_now[n];
    });
  refuse(d, "no such quantity of a part");
}

Signal energy_signal(const json& d) {
  const auto name = d.at("energy").get<std::string>();
  const auto of = [](double EnergyLedger::*m) { return [m](const State& s) { return std::vector{s.energy.*m}; }; };
  if (name == "kinetic") return of(&EnergyLedger::kinetic);
  if (name == "internal") return of(&EnergyLedger::internal);
  if (name == "hourglass") return of(&EnergyLedger::hourglass);
  if (name == "spring_damper") return of(&EnergyLedger::spring_damper);
  if (name == "joint") return of(&EnergyLedger::joint);
  if (name == "sliding") return of(&EnergyLedger::sliding);
  if (name == "external_work") return of(&EnergyLedger::external_work);
  if (name == "initial_joint_loss") return of(&EnergyLedger::initial_joint_loss);
  if (name == "total") return [](const State& s) { return std::vector{s.energy.total()}; };
  if (name == "ratio") return [](const State& s) { return std::vector{s.energy.ratio()}; };
  if (name == "balance") return [](const State& s) { return std::vector{s.energy.total() - s.energy.external_work}; };
  refuse(d, "no such energy");
}

Signal momentum_signal(const json& d) {
  const auto name = d.at("momentum").get<std::string>();
  if (name != "linear" && name != "angular") refuse(d, "linear or angular");
  return [angular = name == "angular"](const State& s) {
    Vec3 sum{};
    for (std::size_t b = 0; b < s.bodies.motion.size(); ++b) {
      const BodyMotion& m = s.bodies.motion[b];
      const Vec3 p = s.bodies.info[b].mass * m.velocity;
      sum += angular ? cross(m.center, p) + m.angular_momentum : p;
    }
    return components(sum);
  };
}

Signal combined_signal(const json& d, const Model& model, const State& state) {
  const char* how = d.contains("sum") ? "sum" : d.contains("join") ? "join" : "quotient";
  std::vector<Signal> parts;
  for (const json& part : d.at(how)) parts.push_back(make_signal(part, model, state));
  if (parts.empty()) refuse(d, "it combines nothing");
  if (d.contains("join"))
    return [parts](const State& s) {
      std::vector<double> all;
      for (const Signal& part : parts) {
        const auto v = part(s);
        all.insert(all.end(), v.begin(), v.end());
      }
      return all;
    };
  if (d.contains("quotient")) {
    if (parts.size() != 2) refuse(d, "a quotient has two signals");
    return [a = parts[0], b = parts[1]](const State& s) { return std::vector{a(s).at(0) / b(s).at(0)}; };
  }
  return [parts](const State& s) {
    auto sum = parts[0](s);
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const auto v = parts[i](s);
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += v.at(c);
    }
    return sum;
  };
}

Signal source_signal(const json& d, const Model& model, const State& state) {
  if (d.contains("body")) return body_signal(d, state);
  if (d.contains("relative")) return relative_signal(d, state);
  if (d.contains("node")) return node_signal(d, model);
  if (d.contains("solid")) return solid_signal(d, model, state);
  if (d.contains("joint")) return joint_signal(d, model);
  if (d.contains("stiffness")) return stiffness_signal(d, model);
  if (d.contains("contact")) return contact_signal(d, model);
  if (d.contains("wall")) return wall_signal(d, model);
  if (d.contains("part")) return part_signal(d, model);
  if (d.contains("energy")) return energy_signal(d);
  if (d.contains("momentum")) return momentum_signal(d);
  if (d.contains("sum") || d.contains("join") || d.contains("quotient")) return combined_signal(d, model, state);
  refuse(d, "no kind of signal that is known");
}

}  // namespace

Signal make_signal(const json& description, const Model& model, const State& state) {
  try {
    Signal signal = source_signal(description, model, state);
    if (description.contains("along"))
      signal = [signal, axis = vector_of(description["along"])](const State& s) {
        const auto v = signal(s);
        return std::vector{v.at(0) * axis.x + v.at(1) * axis.y + v.at(2) * axis.z};
      };
    if (description.contains("components"))
      signal = [signal, pick = description["components"].get<std::vector<std::size_t>>()](const State& s) {
        const auto v = signal(s);
        std::vector<double> picked;
        for (const std::size_t i : pick) picked.push_back(v.at(i));
        return picked;
      };
    if (description.value("norm", false)) signal = [signal](const State& s) { return std::vector{length(signal(s))}; };
    if (description.contains("factor") || description.contains("offset"))
      signal = [signal, f = description.value("factor", 1.0), o = description.value("offset", 0.0)](const State& s) {
        auto v = signal(s);
        for (double& c : v) c = f * c + o;
        return v;
      };
    return signal;
  } catch (const json::exception& e) {
    refuse(description, e.what());
  }
}

}  // namespace kardan::verify
