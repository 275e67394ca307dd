#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapters/files/columns.hpp"
#include "adapters/files/frame.hpp"

namespace crossgrain::files {

/// Contacts as rows of a file, with data that need the particles: a force in parts, a normal from
/// the centres.
struct ContactTable {
  FileContacts contacts;
  std::vector<Vec3> tangential;    ///< tangential force on the first, beside contacts.normalForce
  std::vector<Vec3> branch;        ///< centre of the first − centre of the second
  std::vector<Vec3> torque;        ///< all of it on the first, lever of the force included
  std::vector<Vec3> rollingForce;  ///< rolling pseudo-force
  std::vector<std::pair<Vec3, Vec3>> ends;  ///< centres of both, in place of ids
};

void reserve(ContactTable& table, const Columns& columns, std::size_t rows);
/// Adds the row that was read; a wall that is the first becomes the second. @throws BadInput
void addContact(ContactTable& table, const Columns& columns, const TextFile& text);
/// Refuses columns of which no contact can be made. @throws BadInput saying what is missing
void checkContactColumns(const Columns& columns, const TextFile& text);

/// Where particles are by their ids; of two with one id the first.
class RowOfId {
 public:
  explicit RowOfId(const std::vector<std::int64_t>& ids);
  /// @throws BadInput where two have one id
  explicit RowOfId(const FileFrame& frame);
  std::optional<std::size_t> operator[](std::int64_t id) const;

 private:
  std::optional<std::int64_t> twice_;  ///< an id of two
  std::int64_t lowest_ = 0;
  std::vector<std::uint32_t> dense_;                            ///< row by id − lowest_
  std::vector<std::pair<std::int64_t, std::uint32_t>> sparse_;  ///< else, sorted
};

/// x − y, over the nearest edges of a periodic box.
Vec3 nearestImage(Vec3 difference, const std::optional<FileBox>& box);

/// Borders of which nothing is said, or that a program which wrote the dump anew calls fixed, are
/// periodic where the case's are and the box is as wide.
void takePeriods(FileBox& box, const FileBox& ofCase);

/// The contacts of a table, all in the terms of FileContacts. Particles are those of their time.
/// Normals are taken as given, else from the branch, else from the centres; force = f_n n + f_t;
/// torque of rolling resistance = R* n × (pseudo-force) [LAMMPS, pair_granular.cpp: torroll], or
/// the whole torque without −(R − δ/2) n × F.
/// @param where  of the table, for messages  @throws BadInput
FileContacts completed(ContactTable table, const FileFrame& particles, const std::string& where);

/// Adds contacts; arrays that one of both does not have are dropped. Points that pairs of spheres
/// lack are worked out: x − n (R − δ/2), with δ of the centres.
void append(FileContacts& contacts, FileContacts more, const FileFrame& particles);

}  // namespace crossgrain::files
