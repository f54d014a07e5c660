#pragma once

#include <string>

#include "formwork/report/report.hpp"

namespace formwork {

/// The report's data as JSON text: geometry and fields as base64 arrays (16 bit steps between two
/// ends where numbers are shown only), everything else readable. The page's data.js is its reader.
std::string report_data(const ReportInput& input);

}  // namespace formwork
