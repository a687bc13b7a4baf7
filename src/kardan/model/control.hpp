// How the run is controlled, and what is written.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "kardan/base/index.hpp"
#include "kardan/model/contact.hpp"

namespace kardan {

struct Termination {
  double end_time = 0;        ///< ENDTIM
  std::int64_t end_cycle = 0; ///< ENDCYC, 0 = no limit
  double dt_min = 0;          ///< DTMIN, fraction of the initial dt at which the run stops
  double end_energy = 0;      ///< ENDENG, percent change of the energy ratio at which the run stops
  double end_mass = 1e8;      ///< ENDMAS, percent change of mass
};

struct TimeStepControl {
  double initial = 0;        ///< DTINIT; 0 = computed
  double scale = 0.9;        ///< TSSFAC
  int isdo = 0;
  double dt2ms = 0;
  bool scale_mass_once = false;  ///< MS1ST
  CurveIndex limit = none;   ///< LCTM: largest dt against time
  int erode = 0;
};

struct RigidControl {
  int lmf = -1;              ///< *CONTROL_RIGID LMF: 0 penalty, 1 Lagrange; -1 = not in the deck: Kardan's default, exact
  int jntf = 0;              ///< generalized stiffness: 0 incremental, 1 total, 2 total for implicit
  double gjadstf = 0, gjadvsc = 0, tjadstf = 0, tjadvsc = 0;
};

struct EnergyControl {
  int hgen = 1, rwen = 2, slnten = 1, rylen = 1;
};

/// The files a deck can ask for (*DATABASE_<name>).
enum class OutputFile : std::uint8_t { glstat, matsum, nodout, rbdout, jntforc, bndout, spcforc, deforc, elout, rcforc,
                                       sleout, rwforc, secforc, swforc, ncforc, abstat, nodfor, d3plot, d3thdt,
                                       intfor };
const char* to_string(OutputFile file);

struct OutputRequest {
  double dt = 0;             ///< interval; 0 = not written
  int binary = 0;            ///< BINARY: 1 ASCII, 2 binout, 3 both; 0 = the default, both
  CurveIndex curve = none;   ///< LCUR: interval against time
};

struct OutputControl {
  std::map<OutputFile, OutputRequest> requests;
  std::vector<NodeIndex> history_nodes;
  std::vector<Index> history_shells, history_solids, history_beams, history_discrete;
  int maxint = 3;            ///< *DATABASE_EXTENT_BINARY; its size is the number of layers
  std::int64_t restart_cycles = 0; ///< *DATABASE_BINARY_D3DUMP, _RUNRSF: cycles between two restart files; 0 = not asked for
  bool global_shell_axes = false;  ///< EOCS = 2 of *CONTROL_OUTPUT: shells of ELOUT in global axes, else in their own
};

/// *CONTROL_DYNAMIC_RELAXATION: static equilibrium before t = 0, by damped motion.
struct DynamicRelaxation {
  bool on = false;           ///< IDRFLG = 1, or a curve of SIDR = 1 or 2 and IDRFLG not -999
  std::int64_t check = 250;  ///< NRCYCK: cycles between two checks
  double tolerance = 1e-3;   ///< DRTOL: of the largest kinetic energy
  double factor = 0.995;     ///< DRFCTR: on the velocities, every cycle
  double end_time = 1e28;    ///< DRTERM
  double step_scale = 0;     ///< TSSFDR; 0 = TSSFAC
};

struct Control {
  Termination termination;
  TimeStepControl time_step;
  RigidControl rigid;
  DynamicRelaxation relaxation;
  EnergyControl energy;
  ContactControl contact;
  double bulk_q1 = 1.5, bulk_q2 = 0.06;
  int hourglass_type = 0;
  double hourglass_qm = 0.1;
  int shell_istupd = 0, shell_bwc = 2;
  int shell_theory = 2;       ///< formulation of sections without ELFORM
  int shell_esort = 0;        ///< 1: triangles of quadrilateral formulations are C0 triangles (ELFORM 4)
  bool shell_lobatto = false; ///< INTGRD = 1: 3 to 10 points through the thickness by Lobatto's rule
  int solid_esort = 0;       ///< *CONTROL_SOLID: 1 degenerate solids become tetrahedra (10) and pentahedra (15)
};

}  // namespace kardan
