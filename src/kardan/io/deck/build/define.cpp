// *DEFINE: curves, tables, coordinate systems, vectors, boxes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "kardan/io/deck/build/builder.hpp"
#include "kardan/io/deck/build/curve_function.hpp"

namespace kardan::deck {

namespace {

std::string title_of(Block& block) {
  return block.has("TITLE") ? block.next_title() : std::string();
}
double or_one(double factor) {
  return factor == 0 ? 1.0 : factor;
}

/// SIDR of a curve's head; reports what it asks for and Kardan does not do.
Curve::Phase curve_phase(Builder& b, const Block& block, const Card& card) {
  const IncludeContext& context = block.context();
  if (context.mass != 1 || context.length != 1 || context.time != 1) {
    b.unsupported(block,
                  "unit factors of *INCLUDE_TRANSFORM on a curve are not available: the units of its values depend "
                  "on who uses it",
                  "move the curve to the main deck in its units");
  }
  constexpr std::array phases{Curve::Phase::transient, Curve::Phase::relaxation, Curve::Phase::both};
  const Curve::Phase phase = phases[static_cast<std::size_t>(b.integer_in(card, "sidr", 0, 2))];
  if (phase != Curve::Phase::transient) b.relaxation_curves = true;
  return phase;
}

/// Makes the abscissae ascend strictly: sorts the points where they do not ascend, drops repeated points, and moves the
/// second point of a jump by 1e-9 of the range. Each is said.
void put_in_order(const Card& card, Curve& curve) {
  const auto warn = [&](const std::string& what, const std::string& cure) {
    card.warning("lcid", "curve " + std::to_string(curve.id) + ": " + what, cure);
  };
  std::vector<std::pair<double, double>> points(curve.x.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {curve.x[i], curve.y[i]};
  const auto before = [](const auto& p, const auto& q) { return p.first < q.first; };
  const auto wrong = std::is_sorted_until(points.begin(), points.end(), before);
  if (wrong != points.end()) {
    const bool falling = std::is_sorted(points.rbegin(), points.rend(), before);
    warn("the abscissae do not ascend (" + fmt::format("{:g} after {:g}", wrong->first, (wrong - 1)->first) +
             "); its points are taken in ascending order",
         falling ? "write the points in ascending order" : "check these points for a slip of the pen");
    std::stable_sort(points.begin(), points.end(), before);
  }
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.empty()) return;
  const double step = 1e-9 * std::max(points.back().first - points.front().first, 1e-300);
  bool jump = false;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].first > points[i - 1].first) continue;
    points[i].first = std::max(points[i - 1].first + step, std::nextafter(points[i - 1].first, INFINITY));
    jump = true;
  }
  if (jump)
    warn("two points have one abscissa; the jump is spread over 1e-9 of the curve's range", "give two abscissae");
  curve.x.resize(points.size());
  curve.y.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) std::tie(curve.x[i], curve.y[i]) = points[i];
}

/// Two directions of three coordinates each as right-handed axes: x along the first, y in their plane.
bool frame_axes(const Vec3& x, const Vec3& in_plane, Mat3& axes) {
  const Vec3 z = cross(x, in_plane);
  if (!(norm(z) > 1e-12 * norm(x) * norm(in_plane))) return false;
  const Vec3 i = normalized(x), k = normalized(z);
  axes = Mat3::columns(i, cross(k, i), k);
  return true;
}

void add_frame(Builder& b, const Card& card, Frame frame) {
  if (b.frames.enter(card, "cid", static_cast<Index>(b.model.frames.size())))
    b.model.frames.push_back(std::move(frame));
}

}  // namespace

void build_curve(Builder& b, Block& block) {
  Curve curve;
  curve.title = title_of(block);
  const Card card = block.next("card0");
  curve.phase = curve_phase(b, block, card);
  curve.id = card.id("lcid", IdKind::curve);
  const double sfa = or_one(card.real("sfa")), sfo = or_one(card.real("sfo"));
  const double offa = card.real("offa"), offo = card.real("offo");
  const bool any_order = card.integer("dattyp") != 0;
  block.for_each("point", [&](const Card& point) {
    curve.x.push_back(sfa * (point.real(0) + offa));
    curve.y.push_back(sfo * (point.real(1) + offo));
  });
  if (!any_order) put_in_order(card, curve);
  if (curve.x.empty()) {
    card.error("lcid", "curve " + std::to_string(curve.id) + " has no points",
               "give at least one line of abscissa and ordinate");
    curve.x = {0.0};
    curve.y = {0.0};
  }
  if (any_order) {
    b.unsupported(card, "dattyp", "a curve whose abscissae need not ascend is not available", "use DATTYP = 0");
  }
  if (b.curves.enter(card, "lcid", static_cast<CurveIndex>(b.model.curves.size()))) {
    b.curve_of_block[&block] = static_cast<CurveIndex>(b.model.curves.size());
    b.model.curves.push_back(std::move(curve));
  }
}

void build_curve_function(Builder& b, Block& block) {
  constexpr double tolerance = 1e-7;  // of the largest value; straight lines are exact
  Curve curve;
  curve.title = title_of(block);
  const Card card = block.next("card0");
  curve.phase = curve_phase(b, block, card);
  curve.id = card.id("lcid", IdKind::curve);
  std::string text;
  SourceLocation where = card.where();
  for (bool first = true; !block.at_end(); first = false) {
    const Card line = block.next("function");
    if (first) where = line.where();
    text += line.text("function");
  }
  const double sfa = or_one(card.real("sfa")), sfo = or_one(card.real("sfo"));
  const double offa = card.real("offa"), offo = card.real("offo");
  const double end = b.options.end_time > 0 ? b.options.end_time : b.model.control.termination.end_time;
  curve.x = {0.0};
  curve.y = {0.0};
  try {
    const CurveFunction f(text);
    if (!(end > 0)) {
      card.error("lcid", "the function of time cannot be sampled: the run has no end time",
                 "give ENDTIM in *CONTROL_TERMINATION");
    } else if (!sample(f, std::max(end / sfa - offa, 0.0), tolerance, b.options.max_curve_points, curve)) {
      b.diagnostics.error("curve " + std::to_string(curve.id) +
                              ": the function is not finite everywhere up to the end time, or "
                              "needs more than " +
                              std::to_string(b.options.max_curve_points) + " points",
                          "write it as *DEFINE_CURVE", block.as_written(), where);
    }
  } catch (const CurveFunctionError& error) {
    where.column = static_cast<int>(error.position) + 1;
    Diagnostic d{Severity::error,
                 where,
                 block.as_written(),
                 "FUNCTION",
                 error.what(),
                 error.solver_variable ? "functions of the solution are not available; give a function of TIME"
                                       : "correct the expression"};
    if (error.solver_variable)
      b.model.unsupported.push_back(d);
    else
      b.diagnostics.add(d);
  }
  for (double& x : curve.x) x = sfa * (x + offa);
  for (double& y : curve.y) y = sfo * (y + offo);
  if (b.curves.enter(card, "lcid", static_cast<CurveIndex>(b.model.curves.size())))
    b.model.curves.push_back(std::move(curve));
}

void build_table(Builder& b, Block& block) {
  Table table;
  table.title = title_of(block);
  const Card card = block.next("card0");
  table.id = card.id("tbid", IdKind::curve);
  const double sfa = or_one(card.real("sfa")), offa = card.real("offa");
  const Block* next = &block + 1;
  const Block* const end = b.deck.blocks.data() + b.deck.blocks.size();
  block.for_each("value", [&](const Card& line) {
    table.parameter.push_back(sfa * (line.real("value") + offa));
    if (line.id("lcid", IdKind::curve) != 0) {
      table.curve.push_back(b.reference(line, "lcid", b.curves));
      return;
    }
    const auto following = next < end ? b.curve_of_block.find(next) : b.curve_of_block.end();
    if (following == b.curve_of_block.end()) {
      line.error(
          "value", "no curve belongs to this value of table " + std::to_string(table.id),
          "let as many *DEFINE_CURVE follow the table as it has values, or name the curves in the second column");
      table.curve.push_back(none);
    } else {
      table.curve.push_back(following->second);
      ++next;
    }
  });
  if (!std::is_sorted(table.parameter.begin(), table.parameter.end())) {
    card.error("tbid", "the values of table " + std::to_string(table.id) + " do not ascend",
               "sort them with their curves");
  }
  if (b.curves.find(table.id) != none) {
    card.error("tbid", "the number " + std::to_string(table.id) + " is a curve's already",
               "curves and tables share their numbers");
  } else if (b.tables.enter(card, "tbid", static_cast<Index>(b.model.tables.size()))) {
    b.model.tables.push_back(std::move(table));
  }
}

void build_coordinate_system(Builder& b, Block& block) {
  while (!block.at_end()) {
    Frame frame;
    frame.title = title_of(block);
    const Card card = block.next("card0");
    const Card plane = block.next("card1");
    frame.id = card.id("cid", IdKind::define);
    b.refuse_nonzero(plane, "type", "a cylindrical or spherical coordinate system", "use a Cartesian one");
    const Index base = b.optional_reference(card, "cidl", b.frames);
    Vec3 origin = card.point("xo"), on_x = card.point("xl"), in_plane = plane.point("xp");
    if (base != none) {
      const Frame& f = b.model.frames[static_cast<std::size_t>(base)];
      for (Vec3* p : {&origin, &on_x, &in_plane}) *p = f.origin + f.axes * *p;
    }
    frame.origin = origin;
    if (!frame_axes(on_x - origin, in_plane - origin, frame.axes)) {
      card.error("xl", "the three points of coordinate system " + std::to_string(frame.id) + " lie on one line",
                 "give a point on the x-axis and another beside it");
    }
    add_frame(b, card, std::move(frame));
  }
}

void build_coordinate_nodes(Builder& b, Block& block) {
  while (!block.at_end()) {
    Frame frame;
    frame.title = title_of(block);
    const Card card = block.next("card0");
    frame.id = card.id("cid", IdKind::define);
    frame.nodes = {b.node(card, "n1"), b.node(card, "n2"), b.node(card, "n3")};
    frame.moves = b.integer_in(card, "flag", 0, 1) == 1;
    b.refuse_nonzero(card, "type", "a cylindrical or spherical coordinate system", "use a Cartesian one");
    const std::string direction = card.text("dir");
    const char letter =
        direction.empty() ? 'X' : static_cast<char>(std::toupper(static_cast<unsigned char>(direction[0])));
    if (letter < 'X' || letter > 'Z' || direction.size() > 1) {
      card.error("dir", "found " + direction + ", expected X, Y or Z", "correct the axis");
    } else {
      frame.axis = letter - 'X' + 1;
    }
    if (frame.nodes[0] != none && frame.nodes[1] != none && frame.nodes[2] != none) {
      const auto x = [&](std::size_t i) { return b.model.nodes.x[static_cast<std::size_t>(frame.nodes[i])]; };
      frame.origin = x(0);
      // N1-N2 is the local axis DIR, N3 lies in the plane of it and the next axis (xy, yz, zx).
      Mat3 axes = Mat3::identity();
      if (!frame_axes(x(1) - x(0), x(2) - x(0), axes)) {
        card.error("n3", "the three nodes of coordinate system " + std::to_string(frame.id) + " lie on one line",
                   "name a third node beside the axis");
      }
      const Vec3 first = axes.column(0), second = axes.column(1), third = axes.column(2);
      frame.axes = frame.axis == 1
                       ? axes
                       : (frame.axis == 2 ? Mat3::columns(third, first, second) : Mat3::columns(second, third, first));
    }
    add_frame(b, card, std::move(frame));
  }
}

void build_coordinate_vector(Builder& b, Block& block) {
  while (!block.at_end()) {
    Frame frame;
    frame.title = title_of(block);
    const Card card = block.next("card0");
    frame.id = card.id("cid", IdKind::define);
    if (!frame_axes(card.direction("xx"), card.direction("xv"), frame.axes)) {
      card.error("xv", "the two vectors of coordinate system " + std::to_string(frame.id) + " are parallel or zero",
                 "give two vectors that span the xy-plane");
    }
    frame.carrier = b.optional_node(card, "nid");
    if (frame.carrier != none) {
      b.unsupported(card, "nid", "a coordinate system that turns with a node is not available",
                    "use *DEFINE_COORDINATE_NODES with FLAG = 1");
    }
    add_frame(b, card, std::move(frame));
  }
}

void build_vector(Builder& b, Block& block) {
  while (!block.at_end()) {
    const std::string title = title_of(block);
    const Card card = block.next("card0");
    DirectionVector v;
    v.id = card.id("vid", IdKind::define);
    v.frame = b.optional_reference(card, "cid", b.frames);
    v.tail = card.point("xt");
    v.head = card.point("xh");
    if (norm(v.head - v.tail) == 0) {
      card.error("xh", "vector " + std::to_string(v.id) + " has no length", "give a head that differs from the tail");
    }
    if (b.vectors.enter(card, "vid", static_cast<Index>(b.model.vectors.size()))) b.model.vectors.push_back(v);
  }
}

void build_vector_nodes(Builder& b, Block& block) {
  while (!block.at_end()) {
    const std::string title = title_of(block);
    const Card card = block.next("card0");
    DirectionVector v;
    v.id = card.id("vid", IdKind::define);
    v.nodes = {b.node(card, "nodet"), b.node(card, "nodeh")};
    if (v.nodes[0] != none && v.nodes[1] != none) {
      v.tail = b.model.nodes.x[static_cast<std::size_t>(v.nodes[0])];
      v.head = b.model.nodes.x[static_cast<std::size_t>(v.nodes[1])];
    }
    if (b.vectors.enter(card, "vid", static_cast<Index>(b.model.vectors.size()))) b.model.vectors.push_back(v);
  }
}

void build_sd_orientation(Builder& b, Block& block) {
  while (!block.at_end()) {
    const std::string title = title_of(block);
    const Card card = block.next("card0");
    SdOrientation o;
    o.id = card.id("vid", IdKind::define);
    o.iop = b.integer_in(card, "iop", 0, 3);
    if (o.iop <= 1) {
      o.vector = card.direction("xt");
      if (norm(o.vector) == 0) {
        card.error("xt", "the orientation has no direction", "give XT, YT, ZT, or two nodes with IOP = 2 or 3");
      }
    } else {
      o.nodes = {b.node(card, "nid1"), b.node(card, "nid2")};
    }
    if (b.sd_orientations.enter(card, "vid", static_cast<Index>(b.model.sd_orientations.size()))) {
      b.model.sd_orientations.push_back(o);
    }
  }
}

void build_box(Builder& b, Block& block) {
  while (!block.at_end()) {
    const std::string title = title_of(block);
    const Card card = block.next("card0");
    const auto size = [&](const char* field) { return card.real(field, dimension::length); };
    Box box{card.id("boxid", IdKind::define),
            {size("xmn"), size("ymn"), size("zmn")},
            {size("xmx"), size("ymx"), size("zmx")}};
    const Affine& affine = block.context().affine;
    if (!affine.is_identity) {
      b.unsupported(block, "a box in a moved include is not available", "define it in the main deck");
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (box.low[i] > box.high[i]) {
        card.error(i == 0 ? "xmx" : (i == 1 ? "ymx" : "zmx"), "the box's upper bound lies below its lower bound",
                   "exchange them");
      }
    }
    if (b.boxes.enter(card, "boxid", static_cast<Index>(b.box_list.size()))) b.box_list.push_back(box);
  }
}

}  // namespace kardan::deck
