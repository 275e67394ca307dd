#pragma once

#include "tests/reports/report_text.hpp"
