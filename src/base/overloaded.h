// A visitor of a std::variant, made of one lambda per alternative: std::visit(Overloaded{...}, variant).
#pragma once

namespace hooke {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

// clang 14 does not deduce this itself
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace hooke
