#include "writers_fixture.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace kardan::testing {

namespace {

void add_node(Model& m, UserId id, const Vec3& x) {
  m.nodes.index_of.emplace(id, static_cast<NodeIndex>(m.nodes.size()));
  m.nodes.id.push_back(id);
  m.nodes.x.push_back(x);
  m.nodes.constrained.push_back(0);
}

NodeIndex node(const Model& m, UserId id) {
  return m.nodes.index_of.at(id);
}

PartIndex add_part(Model& m, UserId id, const char* title, ElementKind kind,
                   decltype(Material::law) law) {
  Section s;
  s.kind = kind;
  s.shell.thickness = {1.5, 1.5, 1.5, 1.5};
  m.sections.push_back(s);
  Material material;
  material.law = std::move(law);
  m.materials.push_back(material);
  Part part;
  part.id = id;
  part.title = title;
  part.section = static_cast<Index>(m.sections.size() - 1);
  part.material = static_cast<Index>(m.materials.size() - 1);
  m.parts.push_back(part);
  return static_cast<PartIndex>(m.parts.size() - 1);
}

template <class Block, std::size_t N>
void add_element(Model& m, Block& block, UserId id, PartIndex part, const std::array<UserId, N>& nodes) {
  block.id.push_back(id);
  block.part.push_back(part);
  auto& indices = block.nodes.emplace_back();
  for (std::size_t i = 0; i < N; ++i) indices[i] = nodes[i] == 0 ? none : node(m, nodes[i]);
}

void add_joints(Model& m, PartIndex rigid) {
  Joint global, local;
  global.id = 501;
  global.title = "knee";
  local.id = 502;
  local.local_body = rigid;
  m.joints = {global, local};
  for (const JointStiffnessKind kind :
       {JointStiffnessKind::generalized, JointStiffnessKind::flexion_torsion, JointStiffnessKind::translational}) {
    JointStiffness s;
    s.id = 601 + static_cast<UserId>(m.joint_stiffnesses.size());
    s.kind = kind;
    m.joint_stiffnesses.push_back(s);
  }
}

}  // namespace

Model make_model() {
  Model m;
  m.title = "writer test";
  for (const auto& [id, x] : std::initializer_list<std::pair<UserId, Vec3>>{
           {104, {0, 1, 0}},  {101, {0, 0, 0}},  {102, {1, 0, 0}},  {103, {1, 1, 0}},  {105, {2, 0, 0}},
           {106, {2, 1, 0}},  {1, {5, 0, 0}},    {2, {6, 0, 0}},    {3, {6, 1, 0}},    {4, {5, 1, 0}},
           {11, {5, 0, 1}},   {12, {6, 0, 1}},   {13, {6, 1, 1}},   {14, {5, 1, 1}},   {201, {8, 0, 0}},
           {202, {9, 0, 0}},  {203, {9, 1, 0}},  {204, {8, 1, 0}},  {205, {10, 0, 0}}, {301, {12, 0, 0}},
           {302, {12, 0, 3}}, {303, {12, 4, 0}}, {401, {20, 0, 0}}, {402, {21, 0, 0}}})
    add_node(m, id, x);
  const PartIndex rigid = add_part(m, 10, "rigid plate", ElementKind::shell, RigidMaterial{});
  const PartIndex solid = add_part(m, 20, "block", ElementKind::solid, ElasticMaterial{});
  const PartIndex beam = add_part(m, 5, "strut", ElementKind::beam, ElasticMaterial{});
  const PartIndex shell = add_part(m, 30, "", ElementKind::shell, ElasticMaterial{});
  const PartIndex spring = add_part(m, 7, "spring", ElementKind::discrete, SpringMaterial{});
  add_element<ShellElements, 4>(m, m.shells, 72, rigid, {102, 105, 106, 103});
  add_element<ShellElements, 4>(m, m.shells, 71, rigid, {101, 102, 103, 104});
  add_element<ShellElements, 4>(m, m.shells, 41, shell, {201, 202, 203, 204});
  add_element<ShellElements, 4>(m, m.shells, 80, shell, {202, 205, 203, 203});
  add_element<SolidElements, 8>(m, m.solids, 900, solid, {1, 2, 3, 4, 11, 12, 13, 14});
  add_element<BeamElements, 3>(m, m.beams, 33, beam, {301, 302, 303});
  add_element<DiscreteElements, 2>(m, m.discretes, 31, spring, {303, 106});
  add_element<DiscreteElements, 2>(m, m.discretes, 32, spring, {303, 0});
  m.discretes.print = {0, 0};

  NodalRigidBody nrb;
  nrb.id = 99;
  nrb.nodes = {node(m, 401), node(m, 402)};
  m.nodal_rigid_bodies.push_back(nrb);
  Part nrb_part;
  nrb_part.id = 99;
  nrb_part.nodal_rigid_body = 0;
  m.parts.push_back(nrb_part);
  add_joints(m, rigid);
  m.output.history_nodes = {node(m, 106), node(m, 203)};
  m.control.termination.end_time = 1.0;
  return m;
}

State make_state(const Model& m) {
  State s;
  s.nodes.resize(m.nodes.size());
  s.nodes.x = m.nodes.x;
  s.nodes.mass.assign(m.nodes.size(), 0.25);
  for (const UserId id : {101, 102, 103, 104, 105, 106}) s.nodes.body[static_cast<std::size_t>(node(m, id))] = 0;
  for (const UserId id : {401, 402}) s.nodes.body[static_cast<std::size_t>(node(m, id))] = 1;
  BodyInfo plate, pair;
  plate.id = 10;
  plate.part = 0;
  plate.mass = 3.0;
  plate.initial_center = {1, 0.5, 0};
  plate.initial_orientation = from_rotation_vector({0, 0, 0.3});
  pair.id = 99;
  pair.nodal = true;
  pair.mass = 2.0;
  pair.initial_center = {20.5, 0, 0};
  s.bodies.info = {plate, pair};
  s.bodies.of_part = {0, none, none, none, none, 1};
  s.bodies.motion.resize(2);
  s.bodies.report.resize(2);
  s.joints.resize(m.joints.size());
  s.joint_stiffnesses.resize(m.joint_stiffnesses.size());
  s.discretes.resize(m.discretes.size());
  ReactionReport spc, motion_of_node, motion_of_body;
  spc.node = node(m, 203);
  spc.id = 4;
  motion_of_node.kind = ReactionReport::Kind::motion_of_node;
  motion_of_node.node = node(m, 1);
  motion_of_body.kind = ReactionReport::Kind::motion_of_body;
  motion_of_body.body = 0;
  motion_of_body.id = 8;
  s.reactions = {spc, motion_of_node, motion_of_body};
  const std::size_t parts = m.parts.size();
  s.energy.part_kinetic = s.energy.part_internal = s.energy.part_hourglass = std::vector<double>(parts, 0.0);
  s.energy.part_mass.assign(parts, 0.5);
  s.energy.part_momentum.assign(parts, {1, 2, 3});
  return s;
}

void advance(const Model& m, State& s, double time, double dt, const Motion& motion) {
  s.clock = {static_cast<std::int64_t>(time / dt + 0.5), time, dt, time > 0 ? dt : 0.0};
  const Quat turn = from_rotation_vector({0, 0, motion.spin * time});
  const Vec3 omega{0, 0, motion.spin};
  for (std::size_t b = 0; b < 2; ++b) {
    const Vec3 shift = b == 0 ? motion.velocity * time : Vec3{};
    s.bodies.motion[b].center = s.bodies.info[b].initial_center + shift;
    s.bodies.motion[b].orientation = b == 0 ? turn * s.bodies.info[b].initial_orientation : Quat{};
    s.bodies.report[b].velocity = b == 0 ? motion.velocity : Vec3{};
    s.bodies.report[b].angular_velocity = b == 0 ? omega : Vec3{};
  }
  for (std::size_t n = 0; n < m.nodes.size(); ++n) {
    const BodyIndex b = s.nodes.body[n];
    const Vec3 arm = b == 0 ? to_matrix(turn) * (m.nodes.x[n] - s.bodies.info[0].initial_center) : Vec3{};
    s.nodes.x[n] = b == 0   ? s.bodies.motion[0].center + arm
                   : b == 1 ? m.nodes.x[n]
                            : m.nodes.x[n] + motion.velocity * time;
    s.nodes.v_now[n] = b == 0 ? motion.velocity + cross(omega, arm) : b == 1 ? Vec3{} : motion.velocity;
    s.nodes.a[n] = b == 0 ? cross(omega, cross(omega, arm)) : Vec3{};
  }
  for (std::size_t j = 0; j < s.joints.size(); ++j)
    s.joints[j] = {{100 * time, 200, -300}, {1, 2, 3}, 1e-3 * time, 1e-4, 5 * time, 0};
  for (JointStiffnessReport& r : s.joint_stiffnesses)
    r = {{0.1, 0.2, 0.3}, {1, 2, 3}, {10, 20, 30}, {11, 21, 31}, {21, 41, 61}, 7};
  s.discretes[0] = {-12.5, 0.25, {3, 4, 0}};
  s.reactions[0].force = {1, 2, 3};
  s.reactions[0].moment = {4, 5, 6};
  s.reactions[1].force = {7, 8, 9};
  s.reactions[1].work = 10;
  s.reactions[2].force = {-1, -2, -3};
  s.reactions[2].moment = {-4, -5, -6};
  s.reactions[2].work = time;
  s.energy.kinetic = 10 + time;
  s.energy.internal = 2 * time;
  s.energy.external_work = 3 * time;
  s.energy.initial = 10;
  s.energy.part_kinetic[0] = 4 + time;
  s.energy.part_internal[1] = 2 * time;
}

std::filesystem::path output_directory() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto path = std::filesystem::path(KARDAN_BINARY_DIR) / "test-output" /
                    (std::string(info->test_suite_name()) + "." + info->name());
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

namespace {

ScriptResult run_python(const std::string& arguments) {
  ScriptResult result;
  std::FILE* pipe = popen(("/usr/bin/python3 " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {-1, "cannot start /usr/bin/python3"};
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  result.exit_code = pclose(pipe);
  return result;
}

}  // namespace

ScriptResult run_script(const std::string& script, const std::string& arguments) {
  return run_python("'" KARDAN_SOURCE_DIR "/tests/io/python/" + script + "' " + arguments);
}

bool python_has(const std::string& module) {
  return run_python("-c 'import " + module + "'").exit_code == 0;
}

}  // namespace kardan::testing
