// *TITLE, *CONTROL, *DATABASE.
#include <algorithm>
#include <map>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

void build_title(Builder& b, Block& block) {
  b.model.title = block.next_title();
}

namespace {

void read_termination(Builder& b, Block& block) {
  const Card card = block.next("card0");
  Termination& t = b.model.control.termination;
  t.end_time = card.real("endtim", dimension::time);
  t.end_cycle = card.integer("endcyc");
  t.dt_min = card.real("dtmin");
  t.end_energy = card.real("endeng");
  t.end_mass = Builder::real_or(card, "endmas", 1e8);
  if (t.end_time < 0) card.error("endtim", "is negative", "give the end time of the run");
  b.ignored(card, "nosol", "the run is done");
}

void read_time_step(Builder& b, Block& block) {
  const Card card = block.next("card0");
  const Card more = block.next_optional("card1");
  TimeStepControl& t = b.model.control.time_step;
  t.initial = card.real("dtinit", dimension::time);
  t.scale = Builder::real_or(card, "tssfac", 0.9);
  t.isdo = static_cast<int>(card.integer("isdo"));
  t.dt2ms = card.real("dt2ms", dimension::time);
  t.limit = b.optional_curve(card, "lctm");
  t.erode = static_cast<int>(card.integer("erode"));
  t.scale_mass_once = card.integer("ms1st") == 1;
  if (t.erode < 0 || t.erode > 111 || t.erode % 10 > 1 || t.erode / 10 % 10 > 1)
    card.error("erode", "found " + card.text("erode") + ", expected digits 0 and 1 for beams, shells, solids (1, 10, 11, 100 … 111)", "correct it");
  b.ignored(card, "tslimt", "no element's stiffness is reduced to keep the step");
  b.refuse_nonzero(more, "imscl", "selective mass scaling", "leave it at 0");
  b.refuse_nonzero(more, "dt2mslc", "a curve for DT2MS", "give a constant");
  for (const char* field : {"dt2msf", "rmscl"}) b.ignored(more, field, "masses are scaled by DT2MS alone");
}

void read_rigid(Builder& b, Block& block) {
  const Card card = block.next("card0");
  const Card more = block.next_optional("card1");
  RigidControl& r = b.model.control.rigid;
  r.lmf = card.blank("lmf") ? -1 : b.integer_in(card, "lmf", 0, 1);
  r.jntf = b.integer_in(card, "jntf", 0, 2);
  r.gjadstf = more.real("gjadstf", dimension::rotational_stiffness);
  r.gjadvsc = more.real("gjadvsc", dimension::rotational_damping);
  r.tjadstf = more.real("tjadstf", dimension::stiffness);
  r.tjadvsc = more.real("tjadvsc", dimension::damping);
  for (const char* field : {"gjadstf", "gjadvsc", "tjadstf", "tjadvsc"}) {
    b.refuse_nonzero(more, field, "stiffness or damping added to all joints", "use *CONSTRAINED_JOINT_STIFFNESS");
  }
  b.ignored(card, "metalf", "rigid bodies are updated in full");
  b.ignored(card, "rbsms", "there is no selective mass scaling");
}

void read_energy(Builder& b, Block& block) {
  const Card card = block.next("card0");
  EnergyControl& e = b.model.control.energy;
  e.hgen = static_cast<int>(card.integer("hgen"));
  e.rwen = static_cast<int>(card.integer("rwen"));
  e.slnten = static_cast<int>(card.integer("slnten"));
  e.rylen = static_cast<int>(card.integer("rylen"));
}

void read_shell(Builder& b, Block& block) {
  const Card card = block.next("card0");
  const Card more = block.next_optional("card1");
  Control& c = b.model.control;
  c.shell_istupd = static_cast<int>(card.integer("istupd"));
  if (card.integer("bwc") != 0) c.shell_bwc = static_cast<int>(card.integer("bwc"));
  if (card.integer("theory") != 0) c.shell_theory = static_cast<int>(card.integer("theory"));
  c.shell_esort = static_cast<int>(card.integer("esort"));
  if (c.shell_esort == 2) b.unsupported(card, "esort", "sorting triangles to the DKT formulation (ESORT = 2) is not available", "set ESORT = 1 (C0 triangles)");
  c.shell_lobatto = more.present() && more.integer("intgrd") == 1;
  if (more.present() && !more.is_default("rotascl") && more.real("rotascl") != 0)
    b.unsupported(more, "rotascl", "a scale factor on the rotary inertia of shells is not available", "leave ROTASCL at 1");
  for (const char* field : {"irnxx", "proj"}) b.ignored(card, field, "it has no effect on the formulations of this version");
  b.ignored(card, "miter", "the plane stress condition is always iterated to the end");
  b.ignored(more, "lamsht", "laminated shell theory is not applied");
  const Card update = block.next_optional("card2"), failure = block.next_optional("card3");
  for (const char* field : {"pstupd", "sidt4tu"}) b.refuse_nonzero(update, field, "thickness change of some parts only", "leave it 0: all deformable shells");
  for (const char* field : {"w_mode", "stretch"}) b.refuse_nonzero(update, field, "deletion of distorted shells", "leave it blank");
  b.ignored(update, "icrq", "thickness and plastic strain are those of each element");
  b.refuse_nonzero(block.next_optional("card4"), "lispsid", "initial stresses in the axes of the shells", "give them in global axes");
  for (const char* field : {"nfail1", "nfail4"}) b.ignored(failure, field, "a distorted shell stops the run");
}

void read_relaxation(Builder& b, Block& block) {
  const Card card = block.next("card0");
  DynamicRelaxation& r = b.model.control.relaxation;
  r.check = card.integer("nrcyck") > 0 ? card.integer("nrcyck") : 250;
  r.tolerance = Builder::real_or(card, "drtol", 1e-3);
  r.factor = Builder::real_or(card, "drfctr", 0.995);
  r.end_time = Builder::time_or(card, "drterm", 1e28);
  r.step_scale = card.real("tssfdr");
  if (!(r.factor > 0 && r.factor < 1)) card.error("drfctr", "found " + card.text("drfctr") + ", expected a factor between 0 and 1", "correct it");
  const std::int64_t flag = card.integer("idrflg");
  if (flag != 0 && flag != 1 && flag != -999)
    b.unsupported(card, "idrflg", "relaxation of this kind (IDRFLG = " + card.text("idrflg") + ") is not available", "use IDRFLG = 1");
  b.relaxation = card;
}

void read_solid(Builder& b, Block& block) {
  const Card card = block.next("card0");
  b.model.control.solid_esort = static_cast<int>(card.integer("esort"));
  if (const int sort = b.model.control.solid_esort; sort < 0 || sort > 1)
    b.unsupported(card, "esort", "this sorting of degenerate solids is not available", "give 0 (none) or 1 (to ELFORM 10 and 15)");
  b.refuse_nonzero(card, "psfail", "the restriction of erosion by DTMIN to a set of parts", "leave it at 0");
  b.ignored(card, "tet13k", "tetrahedra ELFORM 13 average their pressure with every material");
}

void read_hourglass(Builder& b, Block& block) {
  const Card card = block.next("card0");
  b.model.control.hourglass_type = static_cast<int>(card.integer("ihq"));
  b.model.control.hourglass_qm = Builder::real_or(card, "qh", 0.1);
}

void read_bulk_viscosity(Builder& b, Block& block) {
  const Card card = block.next("card0");
  b.model.control.bulk_q1 = Builder::real_or(card, "q1", 1.5);
  b.model.control.bulk_q2 = Builder::real_or(card, "q2", 0.06);
  const std::int64_t type = card.integer("type");
  if (type == 2) b.unsupported(card, "type", "the bulk viscosity of Richards and Wilkins is not available", "use TYPE = 1");
  if (type < 0) card.warning("type", "shells have no bulk viscosity; solids have the standard one");
  b.ignored(card, "btype", "beams have no bulk viscosity");
}

void read_output(Builder& b, Block& block) {
  block.next("card0");
  const Card card = block.next_optional("card1");
  b.model.output.global_shell_axes = card.present() && card.integer("eocs") == 2;
}

}  // namespace

void finish_relaxation(Builder& b) {
  const std::int64_t flag = b.relaxation ? b.relaxation->integer("idrflg") : 0;
  DynamicRelaxation& r = b.model.control.relaxation;
  r.on = flag == 1 || (flag == 0 && b.relaxation_curves);
  if (!r.on) return;
  if (b.relaxation)
    b.refuse_nonzero(*b.relaxation, "irelal", "automatic choice of the relaxation factor", "leave IRELAL at 0 and give DRFCTR");
  const auto refuse = [&](std::string message) {
    b.model.unsupported.push_back({Severity::error, {}, "*CONTROL_DYNAMIC_RELAXATION", "", std::move(message),
                                   "use loads, or IDRFLG = -999 for no relaxation"});
  };
  for (const PrescribedMotion& motion : b.model.prescribed_motions) {
    const Curve* curve = motion.curve == none ? nullptr : &b.model.curves[static_cast<std::size_t>(motion.curve)];
    if (motion.body_part != none) {
      refuse("prescribed motions of rigid bodies beside a dynamic relaxation are not available");
      break;
    }
    if (motion.kind == MotionKind::displacement && curve && curve->phase != Curve::Phase::transient) {
      refuse("a prescribed displacement in a dynamic relaxation (SIDR = 1 or 2) is not available");
      break;
    }
  }
  for (const Joint& joint : b.model.joints) {
    if (joint.curve == none) continue;
    refuse("motors beside a dynamic relaxation are not available");
    break;
  }
  if (!b.model.initial_velocities.empty())
    b.diagnostics.notice("the dynamic relaxation begins at rest; initial velocities are set at its end", "*CONTROL_DYNAMIC_RELAXATION");
}

void build_control(Builder& b, Block& block) {
  static const std::map<std::string, Handler> readers{{"CONTROL_TERMINATION", read_termination},
                                                      {"CONTROL_TIMESTEP", read_time_step},
                                                      {"CONTROL_RIGID", read_rigid},
                                                      {"CONTROL_ENERGY", read_energy},
                                                      {"CONTROL_DYNAMIC_RELAXATION", read_relaxation},
                                                      {"CONTROL_SHELL", read_shell},
                                                      {"CONTROL_SOLID", read_solid},
                                                      {"CONTROL_HOURGLASS", read_hourglass},
                                                      {"CONTROL_BULK_VISCOSITY", read_bulk_viscosity},
                                                      {"CONTROL_CONTACT", read_control_contact},
                                                      {"CONTROL_OUTPUT", read_output}};
  const auto reader = readers.find(block.keyword);
  if (reader != readers.end())
    reader->second(b, block);
  else
    block.warning("this control is read but not honoured", "leave it out if its effect is wanted nowhere");
}

namespace {

const std::map<std::string, OutputFile>& files() {
  static const std::map<std::string, OutputFile> names{
      {"GLSTAT", OutputFile::glstat},       {"MATSUM", OutputFile::matsum},   {"NODOUT", OutputFile::nodout},
      {"RBDOUT", OutputFile::rbdout},       {"JNTFORC", OutputFile::jntforc}, {"BNDOUT", OutputFile::bndout},
      {"SPCFORC", OutputFile::spcforc},     {"DEFORC", OutputFile::deforc},   {"ELOUT", OutputFile::elout},
      {"RCFORC", OutputFile::rcforc},       {"SLEOUT", OutputFile::sleout},   {"RWFORC", OutputFile::rwforc},
      {"SECFORC", OutputFile::secforc},     {"SWFORC", OutputFile::swforc},   {"NCFORC", OutputFile::ncforc},
      {"ABSTAT", OutputFile::abstat},       {"NODFOR", OutputFile::nodfor},   {"BINARY_D3PLOT", OutputFile::d3plot},
      {"BINARY_D3THDT", OutputFile::d3thdt},  {"BINARY_INTFOR", OutputFile::intfor}};
  return names;
}

void read_extent(Builder& b, Block& block) {
  const Card card = block.next("card0");
  const std::int64_t points = card.integer("maxint");
  b.model.output.maxint = points == 0 ? 3 : static_cast<int>(points);
  if (points < 0) card.warning("maxint", "is negative: the points in the plane of fully integrated shells are not written one by one, but their mean");
  b.ignored(card, "strflg", "strain tensors are not written");
  for (const char* field : {"neiph", "neips"}) b.ignored(card, field, "history variables other than the plastic strain are not written");
  for (const char* field : {"sigflg", "epsflg", "rltflg", "engflg"}) b.ignored(card, field, "d3plot holds everything");
  const Card more = block.next_optional("card1"), last = block.next_optional("card2");
  b.ignored(more, "ieverp", "a file holds as many states as fit");
  b.ignored(more, "beamip", "the stresses at the points of beams are not written, but their resultants");
  b.ignored(more, "dcomp", "all words are written");
  for (const char* field : {"shge", "stssz"}) b.ignored(more, field, "hourglass energy and time step of elements are not written");
  for (const char* field : {"hydro", "msscl", "therm", "nintsld"}) b.ignored(last, field, "not written");
}

void read_restart_files(Builder& b, Block& block) {
  const Card card = block.next_optional("card0");
  const double cycles = card.real("cycl");
  if (cycles < 0) return card.error("cycl", "is negative", "give the number of cycles between two restart files");
  if (Builder::has_field(block, "card0", "nr") && card.integer("nr") > 2) b.ignored(card, "nr", "the last two restart files are kept");
  if (cycles < 1) return;
  std::int64_t& every = b.model.output.restart_cycles;
  const auto own = static_cast<std::int64_t>(std::min(cycles, 1e15));
  every = every > 0 ? std::min(every, own) : own;
}

}  // namespace

void build_database(Builder& b, Block& block) {
  if (block.keyword == "DATABASE_BINARY_D3DUMP" || block.keyword == "DATABASE_BINARY_RUNRSF") return read_restart_files(b, block);
  if (block.keyword == "DATABASE_EXTENT_BINARY") return read_extent(b, block);
  const auto file = files().find(block.keyword.substr(std::string("DATABASE_").size()));
  if (file == files().end()) {
    block.warning("this result is not written");
    return;
  }
  const Card card = block.next("card0");
  OutputRequest request;
  request.dt = card.real("dt", dimension::time);
  if (request.dt < 0) card.error("dt", "is negative", "give the time between two outputs");
  if (Builder::has_field(block, "card0", "lcdt")) {
    request.curve = b.optional_curve(card, "lcdt");
    const std::int64_t plots = card.integer("npltc");
    if (plots > 0) request.dt = b.model.control.termination.end_time / static_cast<double>(plots);
    b.ignored(card, "psetid", "all parts are written");
  } else {
    request.curve = b.optional_curve(card, "lcur");
    request.binary = b.integer_in(card, "binary", 0, 3);
  }
  b.model.output.requests[file->second] = request;
}

void build_history(Builder& b, Block& block) {
  const std::string what = block.keyword.substr(std::string("DATABASE_HISTORY_").size());
  const bool set = what.ends_with("_SET");
  const std::string kind = set ? what.substr(0, what.size() - 4) : what;
  OutputControl& out = b.model.output;
  struct Target {
    std::vector<Index>* list;
    SetKind kind;
    ElementKind elements;
  };
  const std::map<std::string, Target> targets{
      {"NODE", {&out.history_nodes, SetKind::node, ElementKind::shell}},
      {"SHELL", {&out.history_shells, SetKind::shell, ElementKind::shell}},
      {"SOLID", {&out.history_solids, SetKind::solid, ElementKind::solid}},
      {"BEAM", {&out.history_beams, SetKind::beam, ElementKind::beam}},
      {"DISCRETE", {&out.history_discrete, SetKind::discrete, ElementKind::discrete}}};
  const auto target = targets.find(kind);
  if (target == targets.end()) {
    block.warning("histories of these are not written");
    return;
  }
  const auto [list, set_kind, elements] = target->second;
  const auto add = [&, l = list, k = set_kind, e = elements](const Card& card, const std::string& field) {
    if (card.integer(field) == 0) return;
    if (set) {
      const Index s = b.sets->reference(card, field, k);
      if (s == none) return;
      const std::vector<Index>& members = k == SetKind::node
                                              ? b.model.node_sets[static_cast<std::size_t>(s)].nodes
                                              : b.model.element_sets[static_cast<std::size_t>(s)].elements;
      l->insert(l->end(), members.begin(), members.end());
    } else if (k == SetKind::node) {
      if (const NodeIndex n = b.node(card, field); n != none) l->push_back(n);
    } else {
      const UserId id = card.id(field, IdKind::element);
      const Index i = b.elements[static_cast<std::size_t>(e)].index(id);
      if (i == none)
        card.error(field, "element " + std::to_string(id) + " is not defined", "take it out of the list");
      else
        l->push_back(i);
    }
  };
  if (block.has("ID") && block.info->find_card("named") == nullptr) {
    block.error("has no option ID here", "leave _ID out, or list the members with *DATABASE_HISTORY_NODE_ID");
    return;
  }
  if (block.has("ID")) {
    block.for_each("named", [&](const Card& card) { add(card, "id1"); });
    return;
  }
  block.for_each("card0", [&](const Card& card) {
    for (int i = 1; i <= 8; ++i) add(card, "id" + std::to_string(i));
  });
}

}  // namespace kardan::deck
