#include "tests/paths.hpp"

std::string project_dir() { return PROJECT_DIR; }
std::string test_data_dir() { return TEST_DATA_DIR; }
std::string arcsim_program() { return ARCSIM_PROGRAM; }
std::string formwork_program() { return FORMWORK_PROGRAM; }
