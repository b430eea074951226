// A visitor of a std::variant, made of one lambda per alternative: std::visit(Overloaded{...}, variant).
#pragma once

#include <type_traits>

namespace hooke {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

// clang 14 does not deduce this itself
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

// Whether a type is one of several.
template <class Type, class... Types>
inline constexpr bool is_one_of = (std::is_same_v<Type, Types> || ...);

}  // namespace hooke
