#include "kardan/loads/load_system.hpp"

namespace kardan {

struct LoadSystem::Impl {};

LoadSystem::LoadSystem(const Model&, State&, Diagnostics&) : impl_(std::make_unique<Impl>()) {}
LoadSystem::~LoadSystem() = default;
LoadSystem::LoadSystem(LoadSystem&&) noexcept = default;
LoadSystem& LoadSystem::operator=(LoadSystem&&) noexcept = default;

void LoadSystem::set_initial_velocities(const Model&, State&, Diagnostics&) {}
void LoadSystem::apply(const Model&, State&) {}
void LoadSystem::constrain_velocities(const Model&, State&) {}
void LoadSystem::account(const Model&, State&) {}

}  // namespace kardan
