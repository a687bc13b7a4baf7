#include "kardan/solver/observer.hpp"

namespace kardan {

const char* to_string(Phase phase) {
  static constexpr const char* names[] = {"setup", "loads", "elements", "time step", "contact", "rigid", "nodes", "ledger",
                                          "observers"};
  return names[static_cast<int>(phase)];
}

const char* to_string(StopReason reason) {
  static constexpr const char* names[] = {"running",
                                          "end time reached (ENDTIM)",
                                          "cycle limit reached (ENDCYC)",
                                          "time step below its limit (DTMIN)",
                                          "added mass above its limit (ENDMAS)",
                                          "energy ratio out of its limits (ENDENG)",
                                          "interrupted",
                                          "broken"};
  return names[static_cast<int>(reason)];
}

}  // namespace kardan
