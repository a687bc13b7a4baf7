#include "kardan/io/d3plot/intfor_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace kardan {

namespace {

constexpr std::int64_t segment_words = 16;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

bool is_triangle(const std::array<NodeIndex, 4>& nodes) { return nodes[2] == nodes[3]; }

/// Half the cross product of the diagonals: area times normal, of triangles too.
Vec3 area_vector(const std::array<NodeIndex, 4>& nodes, const std::vector<Vec3>& x) {
  return cross(x[at(nodes[2])] - x[at(nodes[0])], x[at(nodes[3])] - x[at(nodes[1])]) * 0.5;
}

D3plotOptions own_options(D3plotOptions options) {
  options.material_types = false;
  options.file_type = 4;
  options.shell_words = segment_words;
  return options;
}

}  // namespace

bool IntforWriter::has_surfaces(const State& state) {
  return std::any_of(state.contacts.begin(), state.contacts.end(),
                     [](const ContactReport& r) { return !r.segments[0].empty() || !r.segments[1].empty(); });
}

void IntforWriter::gather(const Model& model, const State& state) {
  for (std::size_t c = 0; c < state.contacts.size(); ++c)
    for (std::size_t side = 0; side < 2; ++side) {
      const ContactReport& report = state.contacts[c];
      if (report.segments[side].empty()) continue;
      Part part;
      part.id = static_cast<UserId>(surfaces_.parts.size()) + 1;
      part.title = fmt::format("contact {} {} side", model.contacts[c].id, side == 0 ? "tracked" : "reference");
      const auto p = static_cast<PartIndex>(surfaces_.parts.size());
      surfaces_.parts.push_back(std::move(part));
      for (const auto& nodes : report.segments[side]) {
        Face face{c, side, nodes, {}, {}};
        const double area = norm(area_vector(nodes, model.nodes.x));
        for (std::size_t k = 0; k < (is_triangle(nodes) ? 3u : 4u); ++k) {
          const auto& list = report.nodes[side];
          face.place[k] = static_cast<std::size_t>(std::lower_bound(list.begin(), list.end(), nodes[k]) - list.begin());
          const double all = report.nodal_area[side][face.place[k]];
          face.share[k] = all > 0 ? area / (is_triangle(nodes) ? 3 : 4) / all : 0.0;
          model_node_.push_back(nodes[k]);
        }
        surfaces_.shells.id.push_back(static_cast<UserId>(faces_.size()) + 1);
        surfaces_.shells.part.push_back(p);
        faces_.push_back(face);
      }
    }
  std::sort(model_node_.begin(), model_node_.end());
  model_node_.erase(std::unique(model_node_.begin(), model_node_.end()), model_node_.end());
  for (const NodeIndex n : model_node_) {
    surfaces_.nodes.id.push_back(model.nodes.id[at(n)]);
    surfaces_.nodes.x.push_back(model.nodes.x[at(n)]);
  }
  for (const Face& face : faces_) {
    std::array<NodeIndex, 4> nodes{};
    for (std::size_t k = 0; k < 4; ++k)
      nodes[k] = static_cast<NodeIndex>(std::lower_bound(model_node_.begin(), model_node_.end(), face.nodes[k]) - model_node_.begin());
    surfaces_.shells.nodes.push_back(nodes);
  }
}

IntforWriter::IntforWriter(std::filesystem::path path, const RunLabel& label, const Model& model, const State& state, const D3plotOptions& options) {
  gather(model, state);
  file_.emplace(std::move(path), label, surfaces_, State{}, own_options(options));
}

IntforWriter::IntforWriter(std::filesystem::path path, const Model& model, const State& state, const D3plotOptions& options,
                           const nlohmann::json& mark) {
  gather(model, state);
  file_.emplace(std::move(path), surfaces_, State{}, own_options(options), mark);
}

nlohmann::json IntforWriter::mark() const { return file_->mark(); }

void IntforWriter::write_state(const State& state) {
  WordBuffer out(file_->word_bytes());
  out.real(state.clock.time);
  out.real(state.energy.kinetic);
  out.real(state.energy.internal);
  out.real(state.energy.total());
  out.zeros(3 + 7 * surfaces_.parts.size());
  for (const auto* array : {&state.nodes.x, &state.nodes.v_now, &state.nodes.a})
    for (const Index n : file_->layout().nodes) out.vector((*array)[at(model_node_[at(n)])]);
  for (const Index shell : file_->layout().shells) {
    const Face& face = faces_[at(shell)];
    const std::vector<Vec3>& force = state.contacts[face.contact].nodal_force[face.side];
    std::array<Vec3, 4> nodal{};
    Vec3 total{};
    for (std::size_t k = 0; k < 4; ++k) {
      nodal[k] = force[face.place[k]] * face.share[k];
      total += nodal[k];
    }
    const Vec3 area = area_vector(face.nodes, state.nodes.x);
    const double size = norm(area);
    const Vec3 normal = size > 0 ? area * (1 / size) : Vec3{};
    const Vec3 side = state.nodes.x[at(face.nodes[1])] - state.nodes.x[at(face.nodes[0])];
    const Vec3 r = norm(side) > 0 ? side * (1 / norm(side)) : Vec3{};
    const Vec3 shear = size > 0 ? (total - normal * dot(total, normal)) * (1 / size) : Vec3{};
    out.real(size > 0 ? std::abs(dot(total, normal)) / size : 0.0);
    out.real(norm(shear));
    out.real(dot(shear, r));
    out.real(dot(shear, cross(normal, r)));
    for (const Vec3& f : nodal) out.vector(f);
  }
  file_->append(out);
}

}  // namespace kardan
