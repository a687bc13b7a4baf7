// *MAT_ADD_EROSION: failure criteria on top of a material.
#include <cmath>

#include "kardan/io/deck/build/builder.hpp"

namespace kardan::deck {

namespace {

constexpr Dimension impulse_dimension{2, -2, -3};  // stress^2 time

/// Reads the limits; a criterion whose field holds EXCL, or nothing on the first card, is not asked for.
class ErosionReader {
 public:
  ErosionReader(Builder& b, const Card& first, const Card& second) : b_(b), first_(first), second_(second), excluded_(first.real("excl")) {}

  ErosionCriteria read() {
    ErosionCriteria e;
    take(first_, "mxpres", dimension::stress, true, e.max_pressure);
    take(first_, "mneps", dimension::none, true, e.min_strain);
    if (asked(first_, "effeps", true)) {
      const double limit = first_.real("effeps");
      (limit > 0 ? e.effective_strain : e.plastic_strain) = std::fabs(limit);
    }
    if (asked(first_, "voleps", true)) {
      const double limit = first_.real("voleps");
      (limit > 0 ? e.expansion : e.compaction) = limit;
    }
    take(second_, "mnpres", dimension::stress, false, e.min_pressure);
    take(second_, "sigp1", dimension::stress, false, e.principal_stress);
    take(second_, "sigvm", dimension::stress, false, e.mises);
    take(second_, "mxeps", dimension::none, false, e.max_strain);
    take(second_, "epssh", dimension::none, false, e.shear_strain);
    if (asked(second_, "impulse", false)) {
      e.impulse = second_.real("impulse", impulse_dimension);
      e.impulse_stress = second_.real("sigth", dimension::stress);
    }
    if (asked(second_, "failtm", false)) e.time = std::fabs(second_.real("failtm", dimension::time));
    for (const char* field : {"sigvm", "mxeps"}) {
      if (asked(second_, field, false) && second_.real(field) < 0)
        b_.unsupported(second_, field, "a curve of failure over the strain rate is not available", "give a positive constant");
    }
    e.needed = Builder::real_or(first_, "ncs", 1);
    e.failing_points = Builder::real_or(first_, "numfip", 1);
    if (e.failing_points < -100)
      b_.unsupported(first_, "numfip", "a value below -100 is not available", "give a number of points, or per cent as -100 to -1");
    return e;
  }

 private:
  bool asked(const Card& card, const char* field, bool zero_is_none) const {
    const double raw = card.real(field);
    return card.present() && raw != excluded_ && !(zero_is_none && raw == 0);
  }
  void take(const Card& card, const char* field, Dimension d, bool zero_is_none, double& limit) const {
    if (asked(card, field, zero_is_none)) limit = card.real(field, d);
  }

  Builder& b_;
  Card first_, second_;
  double excluded_;
};

void refuse_damage(Builder& b, const Card& damage, const Card& strains, const Card& sizes) {
  b.refuse_nonzero(damage, "idam", "damage (GISSMO, DIEM)", "set IDAM = 0");
  b.refuse_nonzero(damage, "dmgtyp", "a type of damage", "set DMGTYP = 0");
  for (const char* field : {"lcfld", "lceps12", "lceps13", "lcepsmx"})
    b.refuse_nonzero(strains, field, "failure by a curve of strains", "use EPSSH or MXEPS");
  for (const char* field : {"engcrt", "radcrt"}) b.refuse_nonzero(strains, field, "failure by energy in a radius", "set ENGCRT = RADCRT = 0");
  b.refuse_nonzero(sizes, "mxtmp", "failure by temperature", "set MXTMP = 0");
  b.ignored(damage, "lcregd", "has no effect without damage");
  b.ignored(sizes, "volfrac", "has no effect: an element is deleted by its points (NUMFIP)");
}

}  // namespace

void build_erosion(Builder& b, Block& block) {
  if (block.has("TITLE")) block.next_title();
  const Card first = block.next("card0"), second = block.next_optional("card1");
  const Index material = b.reference(first, "mid", b.materials);
  ErosionCriteria criteria = ErosionReader(b, first, second).read();
  const Card damage = block.next_optional("card2"), strains = block.next_optional("card3"), sizes = block.next_optional("card4");
  refuse_damage(b, damage, strains, sizes);
  if (const double thinning = strains.real("epsthin"); thinning > 0) criteria.thinning = thinning;
  else if (thinning < 0)
    b.unsupported(strains, "epsthin", "thinning of the whole element is not available", "give EPSTHIN > 0 (of each point)");
  criteria.smallest_step = sizes.real("dtmin", dimension::time);
  if (material == none) return;
  Material& target = b.model.materials[static_cast<std::size_t>(material)];
  const auto* fields = std::get_if<FieldMaterial>(&target.law);
  const bool discrete_beam = fields && (fields->number == 66 || fields->number == 67 || fields->number == 71);
  if (discrete_beam || std::holds_alternative<SpringMaterial>(target.law))
    b.unsupported(first, "mid", "failure criteria of springs, dampers and discrete beams are not available", "use those of the material");
  std::optional<ErosionCriteria>& kept = target.erosion;
  if (kept) first.error("mid", "material " + first.text("mid") + " has failure criteria already", "put all of them into one keyword");
  kept = criteria;
}

}  // namespace kardan::deck
