// *CONSTRAINED_SPOTWELD, _GENERALIZED_WELD, _NODE_SET, _LINEAR, _INTERPOLATION (_LOCAL).
#include <algorithm>
#include <string>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/sets.hpp"

namespace kardan::deck {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Dof bits of a number like 1234: one digit for each degree of freedom.
std::uint8_t dofs_of_digits(const Card& card, std::string_view field) {
  std::uint8_t bits = 0;
  for (std::int64_t rest = card.integer(field); rest > 0; rest /= 10) {
    const std::int64_t digit = rest % 10;
    if (digit < 1 || digit > 6) {
      card.error(field, "found the digit " + std::to_string(digit) + ", expected digits from 1 to 6", "correct the value");
      return 0;
    }
    bits = static_cast<std::uint8_t>(bits | 1u << (digit - 1));
  }
  return bits;
}

/// SN, SS, N, M; nothing where neither strength is given.
std::optional<RigidGroup::Failure> read_failure(const Card& card) {
  RigidGroup::Failure failure;
  failure.normal = card.real("sn");
  failure.shear = card.real("ss");
  failure.normal_exponent = Builder::real_or(card, "n", 1.0);
  failure.shear_exponent = Builder::real_or(card, "m", 1.0);
  for (const char* field : {"sn", "ss"})
    if (card.real(field) < 0) card.error(field, "is negative, expected a force", "give a force, or 0 for no failure");
  if (failure.normal > 0 || failure.shear > 0) return failure;
  return std::nullopt;
}

void refuse_plastic_failure(Builder& b, const Card& card, std::string_view field) {
  const double strain = card.real(field);
  if (strain != 0 && strain < 1e19)
    b.unsupported(card, field, "failure of a weld at a plastic strain is not available", "leave the field blank");
}

/// The number of a weld, node set or equation: its own, or its place in the deck.
UserId number_or(const Card& card, std::string_view field, std::size_t count) {
  const UserId id = card.present() ? card.integer(field) : 0;
  return id != 0 ? id : static_cast<UserId>(count) + 1;
}

void name_weld(Builder& b, const Card& head, RigidGroup::Weld kind, RigidGroup& weld) {
  weld.weld = kind;
  weld.weld_id = number_or(head, "wid", b.model.rigid_groups.size());
  weld.name = "weld " + std::to_string(weld.weld_id);
}

}  // namespace

void build_spotweld(Builder& b, Block& block) {
  while (!block.at_end()) {
    const Card head = block.next_if(block.has("ID"), "wid");
    const Card card = block.next("card0");
    if (!card.present()) return;
    RigidGroup weld;
    name_weld(b, head, RigidGroup::Weld::spot, weld);
    weld.nodes = {b.node(card, "n1"), b.node(card, "n2")};
    weld.failure = read_failure(card);
    weld.death = Builder::time_or(card, "tf", 1e20);
    refuse_plastic_failure(b, card, "ep");
    if (weld.nodes[0] != none && weld.nodes[0] == weld.nodes[1]) {
      card.error("n2", "is node N1 again", "name two nodes");
      continue;
    }
    if (weld.nodes[0] != none && weld.nodes[1] != none) b.model.rigid_groups.push_back(std::move(weld));
  }
}

void build_generalized_weld(Builder& b, Block& block) {
  const bool spot = block.keyword.ends_with("_SPOT");
  while (!block.at_end()) {
    const Card head = block.next_if(block.has("ID"), "wid");
    const Card card = block.next("card0");
    const Card law = block.next("card1");
    if (!law.present()) return;
    RigidGroup weld;
    name_weld(b, head, RigidGroup::Weld::generalized, weld);
    weld.nodes = b.node_set(card, "nsid");
    weld.death = Builder::time_or(law, "tfail", 1e20);
    refuse_plastic_failure(b, law, "epsf");
    if (card.integer("filter") > 1)
      b.unsupported(card, "filter", "failure by filtered forces is not available", "leave FILTER at 0");
    b.ignored(card, "cid", "the forces of welds are written along the line of their nodes and across it");
    if (spot) {
      weld.failure = read_failure(law);
      if (weld.failure && weld.nodes.size() > 2)
        b.unsupported(law, "sn", "failure of a spot weld of more than two nodes is not available", "use one weld for each pair");
    } else {
      b.refuse_nonzero(law, "sigy", "brittle failure of a weld by its stresses", "leave SIGY at 0, or use a spot weld");
    }
    if (weld.nodes.size() >= 2) {
      b.model.rigid_groups.push_back(std::move(weld));
    } else {
      card.error("nsid", "the set has fewer than two nodes", "weld two nodes or more");
    }
  }
}

void build_node_set_constraint(Builder& b, Block& block) {
  static constexpr std::array<std::uint8_t, 8> code_bits{0, 1, 2, 4, 3, 6, 5, 7};
  while (!block.at_end()) {
    const Card head = block.next_if(block.has("ID"), "cnsid");
    const Card card = block.next("card0");
    if (!card.present()) return;
    CommonMotion set;
    set.id = number_or(head, "cnsid", b.model.common_motions.size());
    set.nodes = b.node_set(card, "nsid");
    set.dofs = code_bits[static_cast<std::size_t>(b.integer_in(card, "dof", 1, 7))];
    set.death = Builder::time_or(card, "tf", 1e20);
    if (!set.nodes.empty()) b.model.common_motions.push_back(std::move(set));
  }
}

void build_linear_constraint(Builder& b, Block& block) {
  const bool local = block.keyword.ends_with("_LOCAL");
  const char* number = local ? "lcid" : "licd";
  LinearEquation equation;
  const Card head = block.next("head");
  equation.id = number_or(head, number, b.model.linear_equations.size());
  while (!block.at_end()) {
    const Card card = block.next("card0");
    LinearEquation::Term term;
    term.node = b.node(card, "nid");
    if (card.integer("dof") == 7) {
      b.unsupported(card, "dof", "the voltage of a node (DOF = 7) is not available", "use DOF 1 to 6");
      continue;
    }
    term.dof = b.integer_in(card, "dof", 1, 6);
    if (local) term.frame = b.optional_reference(card, "cid", b.frames);
    term.coefficient = card.real("coef");
    if (term.node != none && term.coefficient != 0) equation.terms.push_back(term);
  }
  if (equation.terms.empty()) {
    block.error("the equation has no term with a coefficient", "give NID, DOF and COEF");
    return;
  }
  b.model.linear_equations.push_back(std::move(equation));
}

namespace {

/// One independent node or set of an interpolation.
void read_independent(Builder& b, const Card& card, bool set, Interpolation& tie) {
  const std::uint8_t dofs = dofs_of_digits(card, "idof");
  if ((dofs & dof_translations) != dof_translations)
    b.unsupported(card, "idof", "independent nodes that take part with some of their translations only are not available",
                  "give IDOF the digits 123");
  tie.asks_rotations = tie.asks_rotations || (dofs & dof_rotations) != 0;
  const double weight = Builder::real_or(card, "twghtx", 1.0);
  for (const char* field : {"twghty", "twghtz"}) {
    if (!card.blank(field) && card.real(field) != 0 && card.real(field) != weight)
      b.unsupported(card, field, "weights that differ by direction are not available", "give one weight, TWGHTX");
  }
  if (weight < 0) card.error("twghtx", "is negative, expected a weight", "give a positive weight");
  for (const char* field : {"rwghtx", "rwghty", "rwghtz"})
    b.ignored(card, field, "the rotations of independent nodes take no part in the fit");
  std::vector<NodeIndex> nodes;
  if (set) {
    nodes = b.node_set(card, "inid");
  } else if (const NodeIndex n = b.node(card, "inid"); n != none) {
    nodes = {n};
  }
  for (const NodeIndex n : nodes) {
    tie.nodes.push_back(n);
    tie.weight.push_back(weight);
  }
}

}  // namespace

void build_interpolation(Builder& b, Block& block) {
  const bool local = block.keyword.ends_with("_LOCAL");
  const Card head = block.next("head");
  Interpolation tie;
  tie.id = number_or(head, "icid", b.model.interpolations.size());
  const bool sets = b.integer_in(head, "ityp", 0, 1) == 1;
  b.refuse_nonzero(head, "fgm", "thermal expansion of an interpolation", "leave FGM at 0");
  if (sets) {
    const std::vector<NodeIndex> dependent = b.node_set(head, "dnid");
    if (dependent.size() == 1) tie.dependent = dependent.front();
    else b.unsupported(head, "dnid", "an interpolation with several dependent nodes is not available", "use one for each node");
  } else {
    tie.dependent = b.node(head, "dnid");
  }
  tie.dofs = dofs_of_digits(head, "ddof");
  if (local) tie.frame = b.optional_reference(head, "cidd", b.frames);
  while (!block.at_end()) {
    const Card card = block.next("card0");
    read_independent(b, card, sets, tie);
    // Independent nodes take part with all translations and one weight: their axes do not matter.
    if (local) b.optional_reference(block.next("independent_axes"), "cidi", b.frames);
  }
  const auto self = std::find(tie.nodes.begin(), tie.nodes.end(), tie.dependent);
  if (self != tie.nodes.end()) {
    head.error("dnid", "node " + std::to_string(b.model.nodes.id[at(tie.dependent)]) + " is independent too", "leave it out of the list");
    return;
  }
  if (tie.nodes.size() < 3) {
    block.error("an interpolation needs three independent nodes that are not on one line", "name more nodes");
    return;
  }
  if (tie.dependent != none && tie.dofs != 0) b.model.interpolations.push_back(std::move(tie));
}

}  // namespace kardan::deck
