#pragma once

#include "support/numbers.hpp"

/// What all reports express numbers with.
namespace crossgrain::reports {

using support::absentText;
using support::at;
using support::finite;
using support::readable;
using support::readableCount;
using support::readableDifference;
using support::readableDuration;
using support::readablePercent;
using support::readableSetting;
using support::shortDuration;
using support::shortly;
using support::times;

}  // namespace crossgrain::reports
