// Shapes as text and back, copies, and equality.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "supernormal/export.h"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The text of a shape: its class and the arguments of its constructor, by name, such as
///     Rounded(core=Superellipsoid(half_axes=(0.02, 0.015, 0.008), delta=8, epsilon=8), radius=0.001)
///
/// Numbers have the fewest digits that read back as the same double. So read_shape(describe(shape)) == shape, to the bit, and
/// both have the same digits in every query. It is also an expression of the Python package. A point has the form (x, y, z), a
/// matrix has three rows of this form, and the points of a Polytope are in square brackets.
///
/// Throws std::invalid_argument with the name of the class if the shape, or one that it is made of, is a CallbackShape or a class
/// of the program, because functions have no text. Also if shapes are nested more than 100 deep.
SUPERNORMAL_API std::string describe(const Shape& shape);

/// The shape with this description. The arguments have the order of describe(). Spaces and line breaks are allowed between words
/// and numbers. A Polytope that is read owns its points.
///
/// Throws std::invalid_argument for any other text, with the place and what is expected there. Arguments out of range are refused
/// as the constructor refuses them.
SUPERNORMAL_API std::shared_ptr<const Shape> read_shape(std::string_view text);

/// A copy that shares nothing with the shape, its parts or a Polytope's points. A CallbackShape is copied with its functions.
/// Throws std::invalid_argument with the name of the class for a class of the program.
SUPERNORMAL_API std::shared_ptr<const Shape> clone(const Shape& shape);

/// Whether two shapes are of the same class and have the same parameters. Parts are compared in the same way, and the points of a
/// Polytope in their order. A CallbackShape, or a shape of a class of the program, equals only itself.
SUPERNORMAL_API bool operator==(const Shape& shape1, const Shape& shape2);

}  // namespace supernormal
