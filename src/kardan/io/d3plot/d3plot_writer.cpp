// The family of files and the static sections.
#include "kardan/io/d3plot/d3plot_writer.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "kardan/base/diagnostics.hpp"

namespace kardan {

namespace {

constexpr double end_of_file = -999999.0;

/// IRBTYP: LS-DYNA's number of the material; readers look for 20.
int material_type(const Model& model, PartIndex p) {
  const Index m = model.parts[static_cast<std::size_t>(p)].material;
  if (m == none) return 0;
  const auto& law = model.materials[static_cast<std::size_t>(m)].law;
  if (std::holds_alternative<RigidMaterial>(law)) return 20;
  if (const auto* plastic = std::get_if<PiecewisePlasticMaterial>(&law)) return plastic->modified ? 123 : 24;
  if (const auto* by_fields = std::get_if<FieldMaterial>(&law)) return by_fields->number;
  return std::holds_alternative<ElasticMaterial>(law) ? 1 : 0;
}

template <class Ids>
void require_fit(const Ids& ids, const char* what) {
  for (const UserId id : ids)
    if (id > std::numeric_limits<std::int32_t>::max())
      throw RunError(fmt::format(
          "{} {} does not fit in the 32-bit words of d3plot: renumber it or ask for 64-bit words", what, id));
}

}  // namespace

D3plotWriter::D3plotWriter(std::filesystem::path path, const Model& model, const State& state, const D3plotOptions& options)
    : path_(std::move(path)), options_(options), layout_(model) {
  KARDAN_ASSERT(options_.word_bytes == 4 || options_.word_bytes == 8);
  words_.layers = state.results.shell.layers;
  words_.material_types = options_.material_types;
  words_.shell_words_given = options_.shell_words;
  words_.deletion = state.results.deletable();
  if (options_.word_bytes == 4) {
    require_fit(model.nodes.id, "node");
    require_fit(model.solids.id, "solid");
    require_fit(model.shells.id, "shell");
    require_fit(model.beams.id, "beam");
    require_fit(model.discretes.id, "discrete element");
  }
}

D3plotWriter::D3plotWriter(std::filesystem::path path, const RunLabel& label, const Model& model, const State& state,
                           const D3plotOptions& options)
    : D3plotWriter(std::move(path), model, state, options) {
  file_.emplace(path_);
  write_geometry(label, model);
}

D3plotWriter::D3plotWriter(std::filesystem::path path, const Model& model, const State& state, const D3plotOptions& options,
                           const nlohmann::json& mark)
    : D3plotWriter(std::move(path), model, state, options) {
  file_number_ = first_unsynced_ = mark.at("file_number").get<int>();
  end_ = mark.at("end").get<std::int64_t>();
  file_.emplace(member(file_number_), mark.at("size").get<std::int64_t>());
  if (end_ == 0) return;
  WordBuffer marker(options_.word_bytes);  // the killed run may have written the next state's time over it
  marker.real(end_of_file);
  file_->seek(end_);
  file_->write(marker.bytes().data(), marker.bytes().size());
  file_->flush();
}

nlohmann::json D3plotWriter::mark() const { return {{"file_number", file_number_}, {"end", end_}, {"size", file_->size()}}; }

void D3plotWriter::sync() {
  for (; first_unsynced_ < file_number_; ++first_unsynced_) sync_file(member(first_unsynced_));
  file_->sync();
}

std::filesystem::path D3plotWriter::member(int number) const {
  return number == 0 ? path_ : std::filesystem::path(path_.string() + fmt::format("{:02d}", number));
}

void D3plotWriter::write_geometry(const RunLabel& label, const Model& model) {
  WordBuffer out(options_.word_bytes);
  control_words(label, out);
  if (words_.material_types) {
    out.integer(layout_.rigid_shells);
    out.integer(static_cast<std::int64_t>(layout_.parts.size()));
    for (const Index p : layout_.parts) out.integer(material_type(model, p));
  }
  geometry_words(model, out);
  numbering_words(model, out);
  title_words(label, model, out);
  file_->write(out.bytes().data(), out.bytes().size());
  file_->flush();
}

void D3plotWriter::control_words(const RunLabel& label, WordBuffer& out) const {
  const auto count = [](const auto& v) { return static_cast<std::int64_t>(v.size()); };
  const std::size_t word = out.word_bytes();
  const std::int64_t parts = count(layout_.parts);
  const std::int64_t numbering =
      16 + count(layout_.nodes) + count(layout_.solids) + count(layout_.lines) + count(layout_.shells) + 3 * parts;
  out.text(label.title, 10 * word);
  out.integer(0);                              // 10 run time stamp: none, so that equal runs give equal files
  out.integer(options_.file_type);             // 11
  out.integer(0);                              // 12 source version
  out.text("60", word);                        // 13 release whose layout this is
  out.real(971.0);                             // 14 version: tells readers the floating-point format
  out.integer(words_.material_types ? 5 : 4);  // 15 NDIM: three dimensions, connectivity unpacked
  out.integer(count(layout_.nodes));           // 16 NUMNP
  out.integer(6);                              // 17 ICODE
  out.integer(6 + 7 * parts + 4 * layout_.walls);  // 18 NGLBV
  out.integer(0);                              // 19 IT
  for (int i = 0; i < 3; ++i) out.integer(1);  // 20-22 IU, IV, IA
  out.integer(count(layout_.solids));          // 23 NEL8
  out.integer(layout_.solid_parts);            // 24 NUMMAT8
  out.zeros(2);                                // 25-26
  out.integer(D3plotWords::solid_words);       // 27 NV3D
  out.integer(count(layout_.lines));           // 28 NEL2
  out.integer(layout_.line_parts);             // 29 NUMMAT2
  out.integer(D3plotWords::line_words);        // 30 NV1D
  out.integer(count(layout_.shells));          // 31 NEL4
  out.integer(layout_.shell_parts);            // 32 NUMMAT4
  out.integer(words_.shell_words());           // 33 NV2D
  out.zeros(2);                                // 34-35 NEIPH, NEIPS
  const bool stresses = options_.shell_words == 0;
  out.integer(!stresses ? 0 : words_.deletion ? -(10000 + words_.layers) : words_.layers);  // 36 MAXINT and MDLOPT
  out.zeros(2);                                                             // 37-38 NMSPH, NGPSPH
  out.integer(numbering);                                                   // 39 NARBS
  out.zeros(3);                                                             // 40-42 NELT, NUMMATT, NV3DT
  for (int i = 0; i < 4; ++i) out.integer(stresses ? 1000 : 999);  // 43-46 IOSHL: stress, plastic strain, resultants, thickness …
  out.zeros(4);                                   // 47-50 IALEMAT, NCFDV1, NCFDV2, NADAPT
  out.integer(parts);                             // 51 NMMAT
  out.zeros(12);                                  // 52-63
  KARDAN_ASSERT(out.bytes().size() == 64 * word);
}

void D3plotWriter::geometry_words(const Model& model, WordBuffer& out) const {
  const auto number = [&](NodeIndex n) { return layout_.node_number[static_cast<std::size_t>(n)]; };
  const auto part = [&](PartIndex p) { return layout_.part_number[static_cast<std::size_t>(p)]; };
  for (const Index n : layout_.nodes) out.vector(model.nodes.x[static_cast<std::size_t>(n)]);
  for (const Index e : layout_.solids) {
    NodeIndex last = model.solids.nodes[static_cast<std::size_t>(e)][0];
    for (const NodeIndex n : model.solids.nodes[static_cast<std::size_t>(e)]) {
      if (n != none) last = n;
      out.integer(number(last));
    }
    out.integer(part(model.solids.part[static_cast<std::size_t>(e)]));
  }
  for (const D3plotLayout::Line& line : layout_.lines) {
    const auto e = static_cast<std::size_t>(line.element);
    const NodeIndex a = line.discrete ? model.discretes.nodes[e][0] : model.beams.nodes[e][0];
    const NodeIndex b = line.discrete ? model.discretes.nodes[e][1] : model.beams.nodes[e][1];
    const NodeIndex c = line.discrete ? none : model.beams.nodes[e][2];
    out.integer(number(a));
    out.integer(number(b));
    out.integer(number(c == none ? a : c));
    out.zeros(2);
    out.integer(part(line.discrete ? model.discretes.part[e] : model.beams.part[e]));
  }
  for (const Index e : layout_.shells) {
    NodeIndex last = model.shells.nodes[static_cast<std::size_t>(e)][0];
    for (const NodeIndex n : model.shells.nodes[static_cast<std::size_t>(e)]) {
      if (n != none) last = n;
      out.integer(number(last));
    }
    out.integer(part(model.shells.part[static_cast<std::size_t>(e)]));
  }
}

void D3plotWriter::numbering_words(const Model& model, WordBuffer& out) const {
  const auto count = [](const auto& v) { return static_cast<std::int64_t>(v.size()); };
  const std::int64_t nodes = count(layout_.nodes), solids = count(layout_.solids), lines = count(layout_.lines),
                     shells = count(layout_.shells), parts = count(layout_.parts);
  // Pointers into the solver's memory, as if the lists followed one another from 1; negative: part ids follow.
  const std::int64_t solid_list = 1 + nodes, line_list = solid_list + solids, shell_list = line_list + lines,
                     part_list = shell_list + shells;
  for (const std::int64_t w : {std::int64_t{-1}, solid_list, line_list, shell_list, part_list}) out.integer(w);
  for (const std::int64_t w : {nodes, solids, lines, shells, std::int64_t{0}}) out.integer(w);
  for (const std::int64_t w : {part_list, part_list + parts, part_list + 2 * parts, parts}) out.integer(w);
  out.integer(0);  // NUMRBS: nodal rigid bodies are no parts of the file
  out.integer(parts);
  for (const Index n : layout_.nodes) out.integer(model.nodes.id[static_cast<std::size_t>(n)]);
  for (const Index e : layout_.solids) out.integer(model.solids.id[static_cast<std::size_t>(e)]);
  for (const D3plotLayout::Line& line : layout_.lines) {
    const auto e = static_cast<std::size_t>(line.element);
    out.integer(line.discrete ? model.discretes.id[e] : model.beams.id[e]);
  }
  for (const Index e : layout_.shells) out.integer(model.shells.id[static_cast<std::size_t>(e)]);
  // Ascending ids, ids in internal order (the same here), cross reference.
  for (int list = 0; list < 2; ++list)
    for (const Index p : layout_.parts) out.integer(model.parts[static_cast<std::size_t>(p)].id);
  for (std::int64_t i = 1; i <= parts; ++i) out.integer(i);
}

void D3plotWriter::title_words(const RunLabel& label, const Model& model, WordBuffer& out) const {
  constexpr std::size_t title_bytes = 72;
  out.real(end_of_file);
  out.integer(90001);
  out.integer(static_cast<std::int64_t>(layout_.parts.size()));
  for (const Index p : layout_.parts) {
    const Part& part = model.parts[static_cast<std::size_t>(p)];
    out.integer(part.id);
    out.text(part.title.empty() ? fmt::format("Part {}", part.id) : part.title, title_bytes);
  }
  out.integer(90000);
  out.text(label.title, title_bytes);
  out.real(end_of_file);
}

void D3plotWriter::write_state(const Model& model, const State& state) {
  WordBuffer out(options_.word_bytes);
  out.real(state.clock.time);
  global_words(model, state, out);
  for (const auto* array : {&state.nodes.x, &state.nodes.v_now, &state.nodes.a})
    for (const Index n : layout_.nodes) out.vector((*array)[static_cast<std::size_t>(n)]);
  element_words(model, state, out);
  if (words_.deletion) deletion_words(model, state, out);
  append(out);
}

void D3plotWriter::append(WordBuffer& out) {
  const auto state_bytes = static_cast<std::int64_t>(out.bytes().size());
  out.real(end_of_file);

  const std::int64_t limit = options_.file_words * options_.word_bytes;
  const bool full = end_ > 0 && end_ + static_cast<std::int64_t>(out.bytes().size()) > limit;
  if (file_number_ == 0 || full) {
    file_.emplace(member(++file_number_));
    end_ = 0;
  }
  // The time goes over the end marker last: whatever happens before, readers find the states of before.
  const std::size_t word = out.word_bytes();
  if (end_ > 0) {
    file_->seek(end_ + static_cast<std::int64_t>(word));
    file_->write(out.bytes().data() + word, out.bytes().size() - word);
    file_->flush();
    file_->seek(end_);
    file_->write(out.bytes().data(), word);
  } else {
    file_->write(out.bytes().data(), out.bytes().size());
  }
  file_->flush();
  end_ += state_bytes;
}

}  // namespace kardan
