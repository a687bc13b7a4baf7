// *PARAMETER: definitions, scopes, expressions, and where they go wrong.
#include "deck_test_tools.hpp"

#include <cmath>

namespace kardan::deck {
namespace {

using test::find_message;
using test::Read;
using test::TemporaryFolder;

/// Values of ENDTIM, one for each *CONTROL_TERMINATION of the deck.
std::vector<double> end_times(Read& read) {
  std::vector<double> values;
  for (Block& block : read.deck.blocks) values.push_back(block.next("card0").real("endtim"));
  return values;
}

double value_of(const std::string& definitions, const std::string& field) {
  Read read(definitions + "*CONTROL_TERMINATION\n" + field + ",\n");
  const double value = end_times(read).at(0);
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
  return value;
}

TEST(Parameter, FixedAndFreeDefinitions) {
  const std::string fixed =
      "*PARAMETER\nRVAL1      1.0       IVAL2      2         CVAL3      String    RVAL4      4.5e-3\n";
  EXPECT_EQ(value_of(fixed, "&val1"), 1.0);
  EXPECT_EQ(value_of(fixed, "&VAL2"), 2);
  EXPECT_EQ(value_of(fixed, "-&val4"), -4.5e-3);
  const std::string free_format =
      "*parameter\nrterm, 0.2, istaTES, 80\n*parameter\nr E          12.3\nr pR          00.321\n";
  EXPECT_EQ(value_of(free_format, "&TERM"), 0.2);
  EXPECT_EQ(value_of(free_format, "&states"), 80);
  EXPECT_EQ(value_of(free_format, "&e"), 12.3);
  EXPECT_EQ(value_of(free_format, "&pr"), 0.321);
}

TEST(Parameter, FixedColumnsOfUse) {
  Read read("*PARAMETER\nr a, 3.5, i b, 12\n*NODE\n      &b              &a             -&a       <2.0*a+b>\n");
  const Card card = read.block(0).next("card0");
  EXPECT_EQ(card.integer("nid"), 12);
  EXPECT_EQ(card.real("x"), 3.5);
  EXPECT_EQ(card.real("y"), -3.5);
  EXPECT_EQ(card.real("z"), 19);
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
}

TEST(Parameter, TextParameters) {
  Read read(
      "*PARAMETER\nc name, MECH, c num, "
      "2.5\n*SET_NODE_LIST\n1,0,0,0,0,&name\n*CONTROL_TERMINATION\n&num,\n*CONTROL_TERMINATION\n&name,\n");
  EXPECT_EQ(read.block(0).next("card0").text("solver"), "MECH");
  EXPECT_EQ(read.block(1).next("card0").real("endtim"), 2.5);
  EXPECT_TRUE(read.diagnostics.ok());
  read.block(2).next("card0").real("endtim");
  EXPECT_NE(find_message(read.diagnostics, Severity::error, "is the text 'MECH'"), nullptr);
}

TEST(Parameter, Expressions) {
  const std::string p = "*PARAMETER\nr a, 3.0, i i, 7, i j, 2\n";
  const auto value = [&](const std::string& e) { return value_of(p, "<" + e + ">"); };
  EXPECT_EQ(value("1+2*3"), 7);
  EXPECT_EQ(value("(1+2)*3"), 9);
  EXPECT_EQ(value("2**3**2"), 512);
  EXPECT_EQ(value("-2**2"), -4);
  EXPECT_EQ(value("2.0**-1"), 0.5);
  EXPECT_EQ(value("2/5"), 0) << "integers divide as in Fortran";
  EXPECT_EQ(value("2.0/5"), 0.4);
  EXPECT_EQ(value("i/j"), 3);
  EXPECT_EQ(value("&i/&j"), 3);
  EXPECT_EQ(value("a/j"), 1.5);
  EXPECT_EQ(value("1.5e1+1.d0"), 16);
  EXPECT_EQ(value("5-3"), 2);
  EXPECT_EQ(value("1.5-3"), -1.5);
  EXPECT_EQ(value("max(a, i, -1)"), 7);
  EXPECT_EQ(value("MIN(a,j)"), 2);
  EXPECT_EQ(value("mod(i,4)"), 3);
  EXPECT_EQ(value("mod(7.5,2.0)"), 1.5);
  EXPECT_EQ(value("int(2.9)+nint(2.9)"), 5);
  EXPECT_EQ(value("sign(a,-1)"), -3);
  EXPECT_EQ(value("abs(-2)"), 2);
  EXPECT_DOUBLE_EQ(value("sqrt(2.0)*sin(pi/4)"), 1);
  EXPECT_DOUBLE_EQ(value("atan2(1.0,1.0)"), std::atan(1.0));
  EXPECT_DOUBLE_EQ(value("log10(exp(log(100)))"), 2);
}

TEST(Parameter, ExpressionDefinitions) {
  const std::string definitions =
      "*parameter\nrterm, 0.2, istaTES, 80\n*parameter_expression\nrPlot, tErm/(States-30)\nr half    term/2\ni cut    "
      " 2.9\n"
      "r long    max(term,\n          plot)*10\n";
  EXPECT_DOUBLE_EQ(value_of(definitions, "&plot"), 0.004);
  EXPECT_DOUBLE_EQ(value_of(definitions, "&half"), 0.1);
  EXPECT_EQ(value_of(definitions, "&cut"), 2);
  EXPECT_DOUBLE_EQ(value_of(definitions, "&long"), 2.0);
}

TEST(Parameter, ExpressionFaultsSayWhatAndWhere) {
  struct Case {
    const char *expression, *part;
    int column;
  };
  for (const Case& c : {Case{"1/0", "division by zero", 5},
                        {"undef+1", "parameter 'undef' is not defined", 7},
                        {"(1+2", "')' is missing", 6},
                        {"1+", "missing", 4},
                        {"sqrt(-1.0)", "no finite value", 12},
                        {"foo(1)", "no function 'foo'", 0},
                        {"sin(1,2)", "takes 1 argument", 0},
                        {"1 $ 2", "not expected", 4},
                        {"10.0**400", "no finite value", 0},
                        {"9223372036854775000*10", "too large", 0},
                        {"mod(1,0)", "division by zero", 0},
                        {"0**-1", "division by zero", 0},
                        {"1e999", "too large", 0},
                        {"1.2.3", "not a number", 0}}) {
    Read read(std::string("*CONTROL_TERMINATION\n<") + c.expression + ">,\n");
    EXPECT_EQ(end_times(read).at(0), 0);
    const Diagnostic* message = find_message(read.diagnostics, Severity::error, c.part);
    ASSERT_NE(message, nullptr) << c.expression << "\n" << read.messages();
    EXPECT_EQ(message->where.line, 2);
    EXPECT_EQ(message->field, "ENDTIM");
    if (c.column > 0) {
      EXPECT_EQ(message->where.column, c.column) << c.expression;
    }
  }
}

TEST(Parameter, DeepAndLongExpressionsEndInAnError) {
  for (const std::string& expression :
       {std::string(100000, '('), std::string(3000, '('), "1" + std::string(5000, '0'), [] {
          std::string power = "1";
          for (int i = 0; i < 1000; ++i) power += "**1";
          return power;
        }()}) {
    Read read("*CONTROL_TERMINATION\n<" + expression + ">,\n");
    end_times(read);
    EXPECT_EQ(read.diagnostics.error_count(), 1u) << expression.size();
  }
}

TEST(Parameter, UndefinedAndBadReferences) {
  Read read(
      "*KEYWORD\n*NODE\n         1  &x_coord       0.0       0.0\n       1        &x_coord             0.0             "
      "0.0\n");
  read.block(0).for_each("card0", [](const Card& c) {
    c.integer("nid");
    c.real("x");
  });
  const Diagnostic* shifted = find_message(read.diagnostics, Severity::error, "&name at the start of the field");
  ASSERT_NE(shifted, nullptr) << read.messages();
  EXPECT_EQ(shifted->where.line, 3);
  const Diagnostic* undefined = find_message(read.diagnostics, Severity::error, "parameter 'x_coord' is not defined");
  ASSERT_NE(undefined, nullptr) << read.messages();
  EXPECT_EQ(undefined->where.line, 4);
  EXPECT_EQ(undefined->field, "X");
}

TEST(Parameter, BadDefinitions) {
  const auto message = [](const std::string& line) {
    Read read("*PARAMETER\n" + line + "\n");
    EXPECT_EQ(read.diagnostics.error_count(), 1u) << line << "\n" << read.messages();
    return read.messages();
  };
  EXPECT_NE(message("xscale        1.0").find("expected R, I or C"), std::string::npos);
  EXPECT_NE(message("rscale").find("has no value"), std::string::npos);
  EXPECT_NE(message("rscale        abc").find("expected a real number"), std::string::npos);
  EXPECT_NE(message("r1a,2.0").find("expected R, I or C"), std::string::npos);
  EXPECT_NE(message("ibig,1e30").find("too large"), std::string::npos);
  EXPECT_NE(message("ra,&b").find("parameter 'b' is not defined"), std::string::npos);
}

TEST(Parameter, AValueHoldsFromItsDefinitionOn) {
  Read read(
      "*PARAMETER_DUPLICATION\n4\n*PARAMETER\nr a, 1.0\n*CONTROL_TERMINATION\n&a,\n*PARAMETER\nr a, "
      "2.0\n*CONTROL_TERMINATION\n&a,\n");
  EXPECT_EQ(end_times(read), (std::vector<double>{1, 2}));
}

TEST(Parameter, DuplicationFollowsDflag) {
  const auto second = [](const char* flag, Severity severity, std::size_t messages) {
    Read read(std::string("*PARAMETER_DUPLICATION\n") + flag +
              "\n*PARAMETER\nr a, 1.0\n*PARAMETER\nr a, 2.0\n*CONTROL_TERMINATION\n&a,\n");
    std::size_t found = 0;
    for (const Diagnostic& d : read.diagnostics.all()) found += d.severity == severity;
    EXPECT_EQ(found, messages) << flag << read.messages();
    return end_times(read).at(0);
  };
  EXPECT_EQ(second("", Severity::warning, 1), 1);
  EXPECT_EQ(second("1", Severity::warning, 1), 1);
  EXPECT_EQ(second("2", Severity::warning, 1), 2);
  EXPECT_EQ(second("3", Severity::error, 1), 1);
  EXPECT_EQ(second("4", Severity::warning, 0), 2);
  EXPECT_EQ(second("5", Severity::warning, 0), 1);
  Read same("*PARAMETER\nr a, 1.0\n*PARAMETER\nr a, 1.0\n");
  EXPECT_TRUE(same.diagnostics.all().empty()) << same.messages();
}

TEST(Parameter, LocalParametersStayInTheirFileAndBelow) {
  TemporaryFolder folder;
  folder.write(
      "a.k", "*PARAMETER_LOCAL\nr loc, 1.0\n*PARAMETER\nr glob, 5.0\n*CONTROL_TERMINATION\n&loc,\n*INCLUDE\nbelow.k\n");
  folder.write("below.k", "*CONTROL_TERMINATION\n&loc,\n");
  folder.write("b.k", "*PARAMETER_LOCAL\nr loc, 2.0\n*CONTROL_TERMINATION\n&loc,\n*CONTROL_TERMINATION\n&glob,\n");
  folder.write("c.k", "*CONTROL_TERMINATION\n&loc,\n");
  Read read(folder.write("main.k", "*INCLUDE\na.k\nb.k\nc.k\n"));
  EXPECT_TRUE(read.diagnostics.ok()) << read.messages();
  EXPECT_EQ(end_times(read), (std::vector<double>{1, 1, 2, 5, 0}));
  const Diagnostic* message = find_message(read.diagnostics, Severity::error, "parameter 'loc' is not defined");
  ASSERT_NE(message, nullptr);
  EXPECT_EQ(message->where.file, (folder.path() / "c.k").string());
}

}  // namespace
}  // namespace kardan::deck
