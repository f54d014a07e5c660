#pragma once

#include "formwork/report/report.hpp"

/// A report filled with the synthetic bag, its pictures and made-up figures.
formwork::ReportInput synthetic_report(int around, int up);
