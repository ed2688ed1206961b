#include "supernormal/contact/mesh_contacts.hpp"

#include "contact/mesh/mesh_contact_search.hpp"

namespace supernormal {

MeshContacts::MeshContacts() : search_(std::make_unique<MeshContactSearch>()) {}
MeshContacts::~MeshContacts() = default;
MeshContacts::MeshContacts(MeshContacts&&) noexcept = default;
MeshContacts& MeshContacts::operator=(MeshContacts&&) noexcept = default;

std::span<const MeshContact> MeshContacts::find(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles,
                                                const Settings& settings) {
  return search_->find(shape, pose, triangles, settings, 0);
}

std::span<const MeshContact> MeshContacts::find_within(double distance, const Shape& shape, const Pose& pose,
                                                       std::span<const MeshTriangle> triangles, const Settings& settings) {
  return search_->find(shape, pose, triangles, settings, distance);
}

std::span<const MeshContact> MeshContacts::continued() const { return search_->continued(); }

bool MeshContacts::has_normal(const Vector3& normal, const Vector3& point) const { return search_->has_normal(normal, point); }

int MeshContacts::evaluations() const { return search_->evaluations(); }

}  // namespace supernormal
