#pragma once

#include <string>

/// Where the tests find their inputs and the programs they run.
std::string project_dir();
std::string test_data_dir();
std::string arcsim_program();
std::string formwork_program();
