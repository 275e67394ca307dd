#pragma once

#include "reports/collide/table.hpp"
#include "reports/common/view.hpp"

/// The tables of the page on collisions, as views for its template.
namespace crossgrain::reports {

/// One row per case, one cell per engine: held, fell short by what, or refused and why.
Json matrixRows(const std::vector<CaseGroup>& groups, const std::vector<EngineRow>& engines);

/// One row per variant: what its law has of its own, and for each engine how many of its sweeps
/// held, its errors at the largest time step and the orders fitted.
Json variantRows(const CollideResults& results, const CaseGroup& group);

/// One row per variant and mirror: how far the first engine is from the mirror, which is the
/// model's part, and the mirror from its peer, the implementation's.
Json mirrorRows(const CaseGroup& group, const std::vector<EngineRow>& engines);

/// The quantities that any curve of the case has a score in: their heads, and one row per variant,
/// engine and time step.
Json scoreHeads(const CaseGroup& group);
Json scoreRows(const CaseGroup& group);

}  // namespace crossgrain::reports
