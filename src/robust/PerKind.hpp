// The two kinds of correspondence by name.
#pragma once

namespace hybridgv {
namespace robust {

// One value for each kind: 2D-2D ("rays"), 2D-3D ("points").
template <class Value>
struct PerKind {
  Value rays{}, points{};
};

// The kinds that take part.
using Kinds = PerKind<bool>;
constexpr Kinds kBothKinds{true, true};

}  // namespace robust
}  // namespace hybridgv
