#pragma once

#include "reports/common/overview.hpp"
