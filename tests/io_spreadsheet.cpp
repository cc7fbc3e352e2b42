/// Tables in the units of laboratories.
#include <gtest/gtest.h>

#include "io/results/spreadsheet.hpp"

namespace clathra {
namespace {

TEST(Spreadsheet, HasKilopascalMegapascalAndPercent) {
  EXPECT_EQ(spreadsheet_csv("step,eps1,eps_v,q_Pa,secant_modulus_Pa,void_ratio\n0,0.0123,-0.5,1234567,2.5e8,0.24\n"),
            "step,eps1_pct,eps_v_pct,q_kPa,secant_modulus_MPa,void_ratio\n0,1.23,-50,1234.567,250,0.24\n");
}

TEST(Spreadsheet, LeavesTextEmptyCellsAndOtherUnits) {
  EXPECT_EQ(spreadsheet_csv("name,peak_eps1,peak_q_Pa,compliance_per_Pa,bonds_intact_pct\n\"a, b\",,nan,1,99\nx,0.02,n/a,2,98\n"),
            "name,peak_eps1_pct,peak_q_kPa,compliance_per_Pa,bonds_intact_pct\n\"a, b\",,nan,1,99\nx,2,n/a,2,98\n");
  EXPECT_EQ(spreadsheet_csv(""), "");
  EXPECT_EQ(spreadsheet_csv("eps1\n1\n1,2"), "eps1_pct\n100\n100,2\n") << "a row that is too long";
}

}  // namespace
}  // namespace clathra
