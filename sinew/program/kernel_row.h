// How a row of the table of kernels is made from a function of `math`.
#pragma once

#include <array>
#include <type_traits>
#include <utility>

#include "sinew/math/layout.h"
#include "sinew/program/kernels.h"

namespace sinew::program {

// Reads a row's types off its function: R f(A...) has one port for each argument, then one for the
// result, with the sizes of their layouts.
template <typename Signature>
struct Call;

template <typename F, typename R, typename... A>
struct Call<R (F::*)(A...) const> {
  static constexpr std::array<Port, sizeof...(A) + 1> kPorts = {
      Port{math::Layout<std::remove_cvref_t<A>>::kSize, false}...,
      Port{math::Layout<R>::kSize, true}};

  template <typename S>
  static void apply(S* const* arguments) {
    [arguments]<std::size_t... I>(std::index_sequence<I...>) {
      const R result = F{}(math::Layout<std::remove_cvref_t<A>>::load(arguments[I])...);
      math::Layout<R>::store(result, arguments[sizeof...(I)]);
    }
    (std::index_sequence_for<A...>{});
  }
};

template <typename F>
Kernel row(std::string_view operation, F) {
  using Numeric = Call<decltype(&F::template operator()<double>)>;
  using Tracing = Call<decltype(&F::template operator()<Traced>)>;
  return {operation,
          Numeric::kPorts,
          &Numeric::template apply<double>,
          &Tracing::template apply<Traced>,
          nullptr,
          nullptr};
}

}  // namespace sinew::program
