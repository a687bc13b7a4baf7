#include "kardan/rigid/body_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace kardan {

void MassProperties::add(const MassProperties& piece) {
  const double total = mass + piece.mass;
  if (total <= 0) return;
  const Vec3 new_center = (center * mass + piece.center * piece.mass) * (1.0 / total);
  const auto steiner = [&](double m, const Vec3& c) {
    const Vec3 d = c - new_center;
    return (Mat3::identity() * dot(d, d) - outer(d, d)) * m;
  };
  inertia = inertia + steiner(mass, center) + piece.inertia + steiner(piece.mass, piece.center);
  center = new_center;
  mass = total;
}

namespace {

/// One rigid part or nodal rigid body before merging.
struct Piece {
  UserId id = 0;
  PartIndex part = none;
  const NodalRigidBody* nodal = nullptr;
  const GivenInertia* given = nullptr;
  std::vector<NodeIndex> nodes;        ///< of its elements (or of the set)
  std::vector<NodeIndex> extra;        ///< *CONSTRAINED_EXTRA_NODES whose mass is added
  std::vector<NodeIndex> attached;     ///< *CONSTRAINED_EXTRA_NODES that leave a given inertia as it is (IFLAG = 0)
  int lead = -1;                       ///< piece it is merged into
  int merge_flag = 0;                  ///< IFLAG of the merges into this piece
};

class Assembler {
 public:
  Assembler(const Model& model, State& state, Diagnostics& diagnostics)
      : model_(model), state_(state), diagnostics_(diagnostics) {}

  BodyAssembly assemble() {
    collect_pieces();
    collect_nodes();
    merge();
    make_bodies();
    apply_single_point_constraints();
    return std::move(result_);
  }

 private:
  std::string describe(const Piece& piece) const {
    return piece.nodal ? fmt::format("nodal rigid body {}", piece.id) : fmt::format("rigid part {}", piece.id);
  }

  void collect_pieces() {
    piece_of_part_.assign(model_.parts.size(), -1);
    for (std::size_t p = 0; p < model_.parts.size(); ++p) {
      if (!model_.rigid_part(static_cast<PartIndex>(p))) continue;
      const Part& part = model_.parts[p];
      piece_of_part_[p] = static_cast<int>(pieces_.size());
      Piece piece;
      piece.id = part.id;
      piece.part = static_cast<PartIndex>(p);
      piece.given = part.inertia ? &*part.inertia : nullptr;
      pieces_.push_back(std::move(piece));
    }
    for (const NodalRigidBody& nrb : model_.nodal_rigid_bodies) {
      if (nrb.part != none) piece_of_part_[nrb.part] = static_cast<int>(pieces_.size());
      Piece piece;
      piece.id = nrb.id;
      piece.part = nrb.part;
      piece.nodal = &nrb;
      piece.given = nrb.inertia ? &*nrb.inertia : nullptr;
      piece.nodes = nrb.nodes;
      pieces_.push_back(std::move(piece));
    }
  }

  template <class Elements>
  void collect_element_nodes(const Elements& elements) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const int piece = elements.part[e] == none ? -1 : piece_of_part_[elements.part[e]];
      if (piece < 0) continue;
      for (NodeIndex n : elements.nodes[e])
        if (n != none) pieces_[piece].nodes.push_back(n);
    }
  }

  void collect_nodes() {
    collect_element_nodes(model_.shells);
    collect_element_nodes(model_.solids);
    for (std::size_t e = 0; e < model_.beams.size(); ++e) {  // the third node of a beam only orients it
      const int piece = model_.beams.part[e] == none ? -1 : piece_of_part_[model_.beams.part[e]];
      if (piece < 0) continue;
      for (int i = 0; i < 2; ++i) pieces_[piece].nodes.push_back(model_.beams.nodes[e][i]);
    }
    for (const ExtraNodes& extra : model_.extra_nodes) {
      const int piece = extra.part == none ? -1 : piece_of_part_[extra.part];
      if (piece < 0) {
        diagnostics_.error(fmt::format("part {} is not rigid, nodes cannot be attached to it", part_id(extra.part)),
                           "give the part *MAT_RIGID", "*CONSTRAINED_EXTRA_NODES");
        continue;
      }
      auto& list = pieces_[piece].given && extra.iflag == 0 ? pieces_[piece].attached : pieces_[piece].extra;
      list.insert(list.end(), extra.nodes.begin(), extra.nodes.end());
    }
    for (Piece& piece : pieces_) {
      for (auto* list : {&piece.nodes, &piece.extra, &piece.attached}) {
        std::sort(list->begin(), list->end());
        list->erase(std::unique(list->begin(), list->end()), list->end());
      }
      std::erase_if(piece.extra, [&](NodeIndex n) { return std::binary_search(piece.nodes.begin(), piece.nodes.end(), n); });
    }
  }

  UserId part_id(PartIndex p) const { return p == none ? 0 : model_.parts[p].id; }

  int root(int piece) const {
    while (pieces_[piece].lead >= 0) piece = pieces_[piece].lead;
    return piece;
  }

  void merge() {
    for (const RigidBodyMerge& m : model_.merges) {
      const int lead = m.lead == none ? -1 : piece_of_part_[m.lead];
      const int constrained = m.constrained == none ? -1 : piece_of_part_[m.constrained];
      if (lead < 0 || constrained < 0) {
        diagnostics_.error(fmt::format("parts {} and {} are merged, but {} is not rigid", part_id(m.lead),
                                       part_id(m.constrained), part_id(lead < 0 ? m.lead : m.constrained)),
                           "give it *MAT_RIGID", "*CONSTRAINED_RIGID_BODIES");
        continue;
      }
      const int a = root(lead), b = root(constrained);
      if (a == b) {
        diagnostics_.warning(fmt::format("parts {} and {} are merged twice, or in a circle; one merge is enough",
                                         part_id(m.lead), part_id(m.constrained)), {}, "*CONSTRAINED_RIGID_BODIES");
        continue;
      }
      pieces_[b].lead = a;
      pieces_[a].merge_flag = std::max(pieces_[a].merge_flag, m.iflag);
    }
  }

  /// Sum over lumped nodal masses (eqs. 3 and 6), with the rotary inertia that deformable shells and beams bring to the nodes: the stable
  /// steps of these elements count on it, and a small body between them (a bolt) has little of its own.
  MassProperties lumped(const std::vector<NodeIndex>& nodes) const {
    MassProperties sum;
    Vec3 moment;
    for (NodeIndex n : nodes) {
      sum.mass += state_.nodes.mass[n];
      moment += model_.nodes.x[n] * state_.nodes.mass[n];
    }
    if (sum.mass <= 0) return sum;
    sum.center = moment * (1.0 / sum.mass);
    for (NodeIndex n : nodes) {
      const Vec3 r = model_.nodes.x[n] - sum.center;
      sum.inertia += (Mat3::identity() * dot(r, r) - outer(r, r)) * state_.nodes.mass[n];
      double rotary = state_.nodes.inertia[n];
      if (const auto it = point_inertia_.find(n); it != point_inertia_.end()) {
        sum.inertia += it->second;
        rotary -= trace(it->second) / 3.0;  // the node has the mean of the tensor that the body takes whole
      }
      sum.inertia += Mat3::identity() * std::max(0.0, rotary);
    }
    return sum;
  }

  MassProperties given(const GivenInertia& g) const {
    const Mat3 inertia = g.axes ? *g.axes * g.inertia * transpose(*g.axes) : g.inertia;
    return {g.mass, g.center_node != none ? model_.nodes.x[g.center_node] : g.center, inertia};
  }

  /// Takes the nodes of a piece that no body has yet; a node of another body is an error, one of the same body (shared by
  /// merged parts) is counted once.
  std::vector<NodeIndex> claim(const std::vector<NodeIndex>& nodes, BodyIndex body) {
    std::vector<NodeIndex> mine;
    for (NodeIndex n : nodes) {
      const BodyIndex owner = state_.nodes.body[n];
      if (owner == body) continue;
      if (owner != none) {
        conflicts_[{owner, body}].push_back(n);
        continue;
      }
      state_.nodes.body[n] = body;
      mine.push_back(n);
    }
    return mine;
  }

  void make_bodies() {
    for (const PointInertia& p : model_.inertias) {
      const Mat3 axes = p.frame == none ? Mat3::identity() : model_.frames[p.frame].axes;
      point_inertia_[p.node] += axes * p.inertia * transpose(axes);
    }
    std::vector<std::vector<int>> members(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) members[root(static_cast<int>(i))].push_back(static_cast<int>(i));
    state_.bodies.of_part.assign(model_.parts.size(), none);
    for (std::size_t lead = 0; lead < pieces_.size(); ++lead)
      if (pieces_[lead].lead < 0 && !empty(members[lead])) make_body(static_cast<int>(lead), members[lead]);
    report_conflicts();
    result_.nodes.first.push_back(result_.nodes.node.size());
    finish_arms();
  }

  /// A rigid part without elements, nodes or given inertia makes no body.
  bool empty(const std::vector<int>& members) const {
    for (int m : members)
      if (pieces_[m].given || !pieces_[m].nodes.empty() || !pieces_[m].extra.empty() || !pieces_[m].attached.empty()) return false;
    diagnostics_.warning(fmt::format("{} has no elements and no nodes: ignored", describe(pieces_[members.front()])), {},
                         "*PART");
    return true;
  }

  void make_body(int lead, const std::vector<int>& members) {
    const auto body = static_cast<BodyIndex>(state_.bodies.info.size());
    result_.nodes.first.push_back(result_.nodes.node.size());
    MassProperties total;
    // The lead first: with its own given inertia and IFLAG = 0 the merge does not change it.
    std::vector<int> order{lead};
    for (int m : members)
      if (m != lead) order.push_back(m);
    const bool frozen = pieces_[lead].given && pieces_[lead].merge_flag == 0;
    for (int m : order) {
      const Piece& piece = pieces_[m];
      const std::vector<NodeIndex> own = claim(piece.nodes, body), extra = claim(piece.extra, body),
                                   attached = claim(piece.attached, body);
      if (m == lead || !frozen) {
        total.add(piece.given ? given(*piece.given) : lumped(own));
        total.add(lumped(extra));
      }
      for (const auto* list : {&own, &extra, &attached})
        result_.nodes.node.insert(result_.nodes.node.end(), list->begin(), list->end());
      if (piece.part != none) state_.bodies.of_part[piece.part] = body;
    }
    add_body(pieces_[lead], total);
  }

  void add_body(const Piece& lead, MassProperties total) {
    if (!(total.mass > 0)) {
      diagnostics_.error(fmt::format("{} has no mass", describe(lead)),
                         lead.nodal ? "attach elements or masses to its nodes, or use the _INERTIA option"
                                    : "give its part elements and a density, or use *PART_INERTIA",
                         lead.nodal ? "*CONSTRAINED_NODAL_RIGID_BODY" : "*PART");
      total.mass = 1;
    }
    PrincipalAxes principal = principal_axes(total.inertia);
    if (!(principal.values.x > 1e-12 * principal.values.z) || !(principal.values.x > 0)) {
      diagnostics_.error(fmt::format("{} has no moment of inertia about one axis (principal values {:.4g}, {:.4g}, {:.4g}); "
                                     "its masses lie on a line or in a point", describe(lead), principal.values.x,
                                     principal.values.y, principal.values.z),
                         "give it nodes off the line, *ELEMENT_INERTIA, *PART_INERTIA or the _INERTIA option",
                         lead.nodal ? "*CONSTRAINED_NODAL_RIGID_BODY" : "*PART");
      principal.values = {1, 1, 1};
    }
    BodyInfo info;
    info.id = lead.id;
    info.nodal = lead.nodal != nullptr;
    info.part = lead.part;
    info.mass = total.mass;
    info.principal_inertia = principal.values;
    info.initial_center = total.center;
    info.initial_orientation = from_matrix(principal.axes);
    state_.bodies.info.push_back(info);
    state_.bodies.motion.push_back({total.center, info.initial_orientation, {}, {}, {}});

    BodyFixity fixity;
    if (lead.nodal && lead.nodal->cmo) {
      fixity = fixity_of(*lead.nodal->cmo, lead.nodal->con1, lead.nodal->con2, lead.nodal->constraint_frame);
    } else if (!lead.nodal) {
      const auto& rigid = std::get<RigidMaterial>(model_.materials[model_.parts[lead.part].material].law);
      fixity = fixity_of(rigid.cmo, rigid.con1, rigid.con2, rigid.frame);
    }
    result_.fixity.push_back(fixity);
    result_.given_velocity.push_back(lead.given != nullptr);
    const Mat3 axes = lead.given && lead.given->velocity_frame != none ? model_.frames[lead.given->velocity_frame].axes
                                                                       : Mat3::identity();
    result_.initial_velocity.push_back(lead.given ? axes * lead.given->velocity : Vec3{});
    result_.initial_omega.push_back(lead.given ? axes * lead.given->angular_velocity : Vec3{});
  }

  /// CON1/CON2 codes 0-7 of LS-DYNA: x, y, z, xy, yz, zx, xyz.
  static std::uint8_t code_bits(int code) {
    static constexpr std::uint8_t bits[8] = {0, 1, 2, 4, 3, 6, 5, 7};
    return code >= 0 && code <= 7 ? bits[code] : 0;
  }
  static BodyFixity fixity_of(double cmo, int con1, int con2, Index frame) {
    BodyFixity f;
    if (cmo > 0) {
      f.global = static_cast<std::uint8_t>(code_bits(con1) | (code_bits(con2) << 3));
    } else if (cmo < 0) {
      f.local = static_cast<std::uint8_t>(con2);
      f.frame = frame;
    }
    return f;
  }

  void report_conflicts() {
    for (const auto& [bodies, nodes] : conflicts_) {
      std::string ids;
      for (std::size_t i = 0; i < std::min<std::size_t>(nodes.size(), 8); ++i)
        ids += fmt::format("{}{}", i ? ", " : "", model_.nodes.id[nodes[i]]);
      if (nodes.size() > 8) ids += fmt::format(" and {} more", nodes.size() - 8);
      const auto name = [&](BodyIndex b) {
        const BodyInfo& info = state_.bodies.info[b];
        return fmt::format("{} {}", info.nodal ? "nodal rigid body" : "rigid part", info.id);
      };
      diagnostics_.error(fmt::format("node{} {} belong{} to {} and to {}", nodes.size() > 1 ? "s" : "", ids,
                                     nodes.size() > 1 ? "" : "s", name(bodies.first), name(bodies.second)),
                         "merge the bodies with *CONSTRAINED_RIGID_BODIES, or give each its own nodes",
                         "*CONSTRAINED_RIGID_BODIES");
    }
  }

  void finish_arms() {
    const std::size_t count = state_.bodies.info.size();
    result_.nodes.arm.resize(result_.nodes.node.size());
    for (std::size_t b = 0; b < count; ++b) {
      const Mat3 to_body = transpose(to_matrix(state_.bodies.info[b].initial_orientation));
      for (std::size_t i = result_.nodes.first[b]; i < result_.nodes.first[b + 1]; ++i)
        result_.nodes.arm[i] = to_body * (model_.nodes.x[result_.nodes.node[i]] - state_.bodies.info[b].initial_center);
    }
  }

  void fix(BodyIndex body, std::uint8_t dofs, Index frame, NodeIndex node, const char* keyword) {
    BodyFixity& f = result_.fixity[body];
    const BodyInfo& info = state_.bodies.info[body];
    if (frame != none && f.local != 0 && f.frame != frame) {
      diagnostics_.error(fmt::format("body {} is constrained in two different local frames (node {})", info.id,
                                     model_.nodes.id[node]), "use one frame", keyword);
      return;
    }
    std::uint8_t& bits = frame == none ? f.global : f.local;
    if ((bits | dofs) == bits) return;
    bits = static_cast<std::uint8_t>(bits | dofs);
    if (frame != none) f.frame = frame;
    diagnostics_.notice(fmt::format("node {} belongs to rigid body {}: its constraint (x{} y{} z{} rx{} ry{} rz{}) becomes a "
                                    "constraint of the body", model_.nodes.id[node], info.id, dofs & 1, dofs >> 1 & 1,
                                    dofs >> 2 & 1, dofs >> 3 & 1, dofs >> 4 & 1, dofs >> 5 & 1), keyword);
  }

  void constrain(const SinglePointConstraint& spc, NodeIndex node) {
    const BodyIndex body = state_.nodes.body[node];
    if (spc.birth <= 0 && spc.death >= 1e20) {
      fix(body, spc.dofs, spc.frame, node, "*BOUNDARY_SPC");
      return;
    }
    const std::uint8_t none_of_them = 0;
    result_.timed_fixity.push_back({body,
                                    spc.frame == none ? BodyFixity{spc.dofs, none_of_them, none}
                                                      : BodyFixity{none_of_them, spc.dofs, spc.frame},
                                    spc.birth, spc.death});
    diagnostics_.notice(fmt::format("node {} belongs to rigid body {}: its constraint from t = {:.6g} to {:.6g} becomes a constraint "
                                    "of the body", model_.nodes.id[node], state_.bodies.info[body].id, spc.birth, spc.death),
                        "*BOUNDARY_SPC");
  }

  void apply_single_point_constraints() {
    for (std::size_t n = 0; n < model_.nodes.size(); ++n)
      if (model_.nodes.constrained[n] && state_.nodes.body[n] != none)
        fix(state_.nodes.body[n], model_.nodes.constrained[n], none, static_cast<NodeIndex>(n), "*NODE");
    for (const SinglePointConstraint& spc : model_.constraints)
      for (NodeIndex n : spc.nodes)
        if (state_.nodes.body[n] != none) constrain(spc, n);
  }

  const Model& model_;
  State& state_;
  Diagnostics& diagnostics_;
  BodyAssembly result_;
  std::vector<Piece> pieces_;
  std::vector<int> piece_of_part_;
  std::map<NodeIndex, Mat3> point_inertia_;
  std::map<std::pair<BodyIndex, BodyIndex>, std::vector<NodeIndex>> conflicts_;
};

}  // namespace

BodyAssembly assemble_bodies(const Model& model, State& state, Diagnostics& diagnostics) {
  return Assembler(model, state, diagnostics).assemble();
}

}  // namespace kardan
