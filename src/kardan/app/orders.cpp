#include "kardan/app/orders.hpp"

#include <atomic>
#include <cctype>
#include <csignal>
#include <fstream>

#include "kardan/base/diagnostics.hpp"

namespace kardan::app {

namespace {

enum : unsigned { interrupt = 1, terminate = 2, report = 4 };
std::atomic<unsigned> received{0};
std::atomic<bool> listening{false};
static_assert(std::atomic<unsigned>::is_always_lock_free);

extern "C" void receive(int signal) {
  received.fetch_or(signal == SIGINT ? interrupt : signal == SIGTERM ? terminate : report);
  if (signal != SIGUSR1) std::signal(signal, SIG_DFL);
}

void add_switch(const std::string& word, Orders& orders) {
  if (word == "sw1") orders.stop = orders.dump = true;
  else if (word == "sw2") orders.status = true;
  else if (word == "sw3") orders.dump = true;
  else if (word == "sw4") orders.d3plot = true;
  else if (word == "swa") orders.flush = true;
  else if (word == "stop") orders.stop = true;
  else orders.unknown = word;
}

}  // namespace

SignalOrders::SignalOrders() {
  KARDAN_ASSERT(!listening.exchange(true));
  received = 0;
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, receive);
}

SignalOrders::~SignalOrders() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, SIG_DFL);
  listening = false;
}

bool SignalOrders::pending() const { return received.load(std::memory_order_relaxed) != 0; }

Orders SignalOrders::take() {
  const unsigned signals = received.exchange(0);
  Orders orders;
  orders.stop = orders.dump = (signals & (interrupt | terminate)) != 0;
  orders.status = (signals & report) != 0;
  orders.by = (signals & interrupt) != 0 ? "SIGINT" : "SIGTERM";
  return orders;
}

Orders take_file_orders(const std::filesystem::path& path) {
  Orders orders;
  std::ifstream file(path);
  if (!file) return orders;
  bool written = false;  // else somebody is about to
  for (std::string word; file >> word; written = true) {
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    while (word.ends_with('.')) word.pop_back();
    if (!word.empty()) add_switch(word, orders);
  }
  if (!written) return orders;
  orders.by = "d3kil";
  file.close();
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return orders;
}

}  // namespace kardan::app
