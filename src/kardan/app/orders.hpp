// What the user asks of a running program: signals, and LS-DYNA's sense switches in a file d3kil.
//
//   SIGINT, SIGTERM, sw1   restart file, then the end of the run
//   SIGUSR1, sw2           a line that says how far the run is
//   sw3                    restart file
//   sw4                    d3plot state
//   swa                    result files onto the disk
//   stop                   the end of the run, without a restart file
// Source of the switches: Hallquist, LS-DYNA Keyword User's Manual Vol. I, "Getting started", sense switch controls.
#pragma once

#include <filesystem>
#include <string>

namespace kardan::app {

struct Orders {
  bool stop = false, dump = false, status = false, d3plot = false, flush = false;
  std::string unknown;  ///< a word of d3kil that is no switch
  std::string by;       ///< what asked for the stop: "SIGTERM", "d3kil"

  bool any() const { return stop || dump || status || d3plot || flush || !unknown.empty(); }
};

/// While it lives, signals become orders. A second SIGINT or SIGTERM ends the program. One at a time.
class SignalOrders {
 public:
  SignalOrders();
  ~SignalOrders();
  SignalOrders(const SignalOrders&) = delete;
  SignalOrders& operator=(const SignalOrders&) = delete;

  /// Whether there is something to take(): cheap enough for every cycle.
  bool pending() const;
  Orders take();
};

/// The orders in `path`, which is removed; none where there is no such file.
Orders take_file_orders(const std::filesystem::path& path);

}  // namespace kardan::app
