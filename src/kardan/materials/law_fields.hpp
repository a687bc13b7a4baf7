// What the make() of a law that is read by fields needs: the fields, and complaints that name material and keyword.
#pragma once

#include <string>

#include "kardan/materials/law.hpp"

namespace kardan {

class LawFields {
 public:
  explicit LawFields(LawSource& source)
      : source_(source), fields_(std::get<FieldMaterial>(source.material.law)), errors_(source.diagnostics.error_count()) {
    need(fields_.density > 0, "has no density", "give RO > 0");
  }

  double operator[](std::string_view field) const { return fields_.value(field); }
  const FieldMaterial& fields() const { return fields_; }
  /// The curve of a field, null where it names none.
  const Curve* curve(std::string_view field) const {
    const CurveIndex c = fields_.curve(field);
    return c == none ? nullptr : &source_.model.curves[c];
  }
  bool need(bool condition, const std::string& what, const std::string& cure) {
    if (!condition) source_.diagnostics.error(source_.name + " " + what, cure, fields_.keyword);
    return condition;
  }
  void warn(const std::string& what, const std::string& cure) {
    source_.diagnostics.warning(source_.name + " " + what, cure, fields_.keyword);
  }
  /// Refuses a field that is not zero.
  void refuse(std::string_view field, const std::string& what, const std::string& cure) {
    need(fields_.value(field) == 0 && fields_.curve(field) == none && fields_.table(field) == none,
         "asks for " + what + ", which this version does not compute", cure);
  }
  /// No complaint so far.
  bool good() const { return source_.diagnostics.error_count() == errors_; }

 private:
  LawSource& source_;
  const FieldMaterial& fields_;
  std::size_t errors_;
};

}  // namespace kardan
