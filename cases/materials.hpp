#pragma once

#include <string>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// Every law that two bodies of the case may have: that of [law], or of each two materials.
std::vector<ContactLaw> lawsOf(const Case& setup);

/// That of bodies of two materials of the case.
const ContactLaw& lawOf(const Case& setup, const MaterialName& one, const MaterialName& other);

/// Does the same to all of them.
void changeLaws(Case& setup, auto&& change) {
  change(setup.law);
  if (setup.materials)
    for (ContactLaw& law : setup.materials->laws) change(law);
}

/// Gives a scene of the case the laws of its materials: disks of a cell are small or large by their
/// number, in a packing file by the nearer of the two radii; those of an assembly by their group,
/// and all of a start file are alike.
/// @param scene  disks in the order in which the case has them, and its bodies
template <int D>
void addMaterials(SceneOf<D>& scene, const Case& setup);

/// Fault of the materials that a case names, at the place that says it; of a collision
/// the law of its two becomes the case's.
/// @throws BadInput
void settleMaterials(Case& setup);

/// Of a case without [[law.pairs]]: a name of a material would mean nothing. @throws BadInput
void refuseMaterials(const Case& setup);

}  // namespace crossgrain::inline cases
