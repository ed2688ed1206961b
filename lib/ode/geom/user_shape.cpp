#include "ode/geom/user_shape.hpp"

#include <array>
#include <type_traits>

#include "ode/geom/convert.hpp"
#include "ode/support/require.hpp"
#include "supernormal/shapes/callback_shape.hpp"

namespace supernormal::ode {
namespace {

using Direction = std::array<dReal, 3>;

Direction to_direction(const Vector3& n) { return {to_real(n.x()), to_real(n.y()), to_real(n.z())}; }

CallbackShape::Hessian wrap_hessian(const snShape& shape) {
  if (shape.hessian == nullptr) return {};
  return [shape](const Vector3& n) {
    std::array<dReal, 9> H{};
    shape.hessian(shape.user, to_direction(n).data(), H.data());
    Matrix3 hessian;
    for (int row = 0; row < 3; ++row) hessian.row(row) = to_vector(H.data() + std::ptrdiff_t{3} * row).transpose();
    return hessian;
  };
}

}  // namespace

std::shared_ptr<const Shape> make_user_shape(const snShape* shape) {
  require_not_null("shape", shape);
  const snShape copy = *shape;
  if (copy.support == nullptr) throw std::invalid_argument("shape->support = NULL, but a body needs its support function");
  if (copy.point == nullptr) throw std::invalid_argument("shape->point = NULL, but a body needs its boundary point");
  const auto point = [copy](const Vector3& n) {
    std::array<dReal, 3> r{};
    copy.point(copy.user, to_direction(n).data(), r.data());
    return to_vector(r.data());
  };
  const auto checked = std::make_shared<CallbackShape>(
      [copy](const Vector3& n) { return double{copy.support(copy.user, to_direction(n).data())}; }, point, wrap_hessian(copy));
  if constexpr (std::is_same_v<dReal, double>) return checked;
  // In single precision the callbacks see a rounded direction, and support() returns a rounded length. Only n.r is consistent with
  // the point r. The callback's value can differ from it by more than the depth of contacts with a much smaller body.
  return std::make_shared<CallbackShape>([point](const Vector3& n) { return n.dot(point(n)); }, point, wrap_hessian(copy));
}

}  // namespace supernormal::ode
