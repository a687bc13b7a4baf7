#include "kardan/io/d3plot/d3plot_layout.hpp"

#include <algorithm>
#include <numeric>

#include "kardan/io/tables/summaries.hpp"

namespace kardan {

namespace {

std::vector<Index> ascending(const std::vector<UserId>& ids) {
  std::vector<Index> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](Index a, Index b) {
    return ids[static_cast<std::size_t>(a)] < ids[static_cast<std::size_t>(b)];
  };
  if (!std::is_sorted(order.begin(), order.end(), before)) std::stable_sort(order.begin(), order.end(), before);
  return order;
}

enum : std::uint8_t { by_solid = 1, by_shell = 2, by_line = 4 };

template <class Block>
void mark(const Block& block, std::uint8_t bit, std::vector<std::uint8_t>& used) {
  for (const PartIndex p : block.part) used[static_cast<std::size_t>(p)] |= bit;
}

std::uint8_t kind_of_section(const Model& model, const Part& part) {
  if (part.section == none) return by_shell;
  switch (model.sections[static_cast<std::size_t>(part.section)].kind) {
    case ElementKind::solid:
      return by_solid;
    case ElementKind::beam:
    case ElementKind::discrete:
      return by_line;
    case ElementKind::shell:
      break;
  }
  return by_shell;
}

}  // namespace

D3plotLayout::D3plotLayout(const Model& model)
    : nodes(ascending(model.nodes.id)), solids(ascending(model.solids.id)), shells(ascending(model.shells.id)),
      walls(static_cast<std::int64_t>(model.rigid_walls.size())) {
  node_number.resize(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    node_number[static_cast<std::size_t>(nodes[i])] = static_cast<std::int32_t>(i + 1);

  std::vector<UserId> line_ids;
  std::vector<Line> all_lines;
  for (std::size_t i = 0; i < model.beams.size(); ++i) {
    line_ids.push_back(model.beams.id[i]);
    all_lines.push_back({false, static_cast<Index>(i)});
  }
  for (std::size_t i = 0; i < model.discretes.size(); ++i) {
    if (model.discretes.nodes[i][1] == none) continue;  // to ground: there is no second point to draw
    line_ids.push_back(model.discretes.id[i]);
    all_lines.push_back({true, static_cast<Index>(i)});
  }
  for (const Index i : ascending(line_ids)) lines.push_back(all_lines[static_cast<std::size_t>(i)]);

  std::vector<UserId> part_ids;
  for (const Part& part : model.parts) part_ids.push_back(part.id);
  parts = ascending(part_ids);
  std::erase_if(parts, [&](Index p) { return !listed(model.parts[static_cast<std::size_t>(p)]); });
  std::vector<std::uint8_t> used(model.parts.size(), 0);
  mark(model.solids, by_solid, used);
  mark(model.shells, by_shell, used);
  mark(model.beams, by_line, used);
  mark(model.discretes, by_line, used);
  part_number.assign(model.parts.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto p = static_cast<std::size_t>(parts[i]);
    part_number[p] = static_cast<std::int32_t>(i + 1);
    const std::uint8_t kinds = used[p] != 0 ? used[p] : kind_of_section(model, model.parts[p]);
    if (kinds & by_solid)
      ++solid_parts;
    else if (kinds & by_shell)
      ++shell_parts;
    else
      ++line_parts;
  }
  for (const Index e : shells) {
    rigid_shell.push_back(model.rigid_part(model.shells.part[static_cast<std::size_t>(e)]));
    rigid_shells += rigid_shell.back();
  }
}

}  // namespace kardan
