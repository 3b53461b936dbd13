// Tests: How many processes a launcher has started.
#include "studies/ranks/launched_processes.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

class LaunchedProcesses : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
      unsetenv(name);
    }
  }
  void TearDown() override { SetUp(); }
};

TEST_F(LaunchedProcesses, AreOneWithoutALauncher) { EXPECT_EQ(launched_processes(), 1); }

TEST_F(LaunchedProcesses, AreThoseOfTheLauncher) {
  setenv("SLURM_STEP_NUM_TASKS", "1", 1);
  EXPECT_EQ(launched_processes(), 1);
  setenv("PMI_SIZE", "256", 1);
  EXPECT_EQ(launched_processes(), 256);
  setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
  EXPECT_EQ(launched_processes(), 4) << "an mpirun inside of a step";
}

TEST_F(LaunchedProcesses, AreOneWhereTheirNumberIsNone) {
  setenv("PMI_SIZE", "many", 1);
  EXPECT_EQ(launched_processes(), 1);
}

}  // namespace
}  // namespace nlcwfs
