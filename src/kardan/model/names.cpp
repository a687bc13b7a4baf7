#include "kardan/model/control.hpp"
#include "kardan/model/rigid.hpp"

namespace kardan {

const char* to_string(JointKind kind) {
  static constexpr const char* names[] = {"spherical", "revolute", "cylindrical", "planar", "universal", "translational",
                                          "locking", "translational_motor", "rotational_motor", "gears",
                                          "rack_and_pinion", "constant_velocity", "pulley", "screw"};
  return names[static_cast<int>(kind)];
}

const char* to_string(OutputFile file) {
  static constexpr const char* names[] = {"glstat", "matsum", "nodout", "rbdout", "jntforc", "bndout", "spcforc",
                                          "deforc", "elout", "rcforc", "sleout", "rwforc", "secforc", "swforc",
                                          "ncforc", "abstat", "nodfor", "d3plot", "d3thdt", "intfor"};
  return names[static_cast<int>(file)];
}

}  // namespace kardan
