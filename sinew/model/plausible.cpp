#include "sinew/model/plausible.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/model/inertia.h"

namespace sinew::model {
namespace {

math::Symmetric3<double> second_moments(const math::Symmetric3<double>& I) {
  const double half = 0.5 * (I.xx + I.yy + I.zz);
  return {half - I.xx, -I.xy, -I.xz, half - I.yy, -I.yz, half - I.zz};
}

// In parts of the largest moment: how far the smallest eigenvalue of each is below zero.
struct Violation {
  double moment = 0, triangle = 0, largest = 0;
};

Violation violation(const math::Symmetric3<double>& I) {
  const Vector3 moments = eigenvalues(I);
  const double scale = std::max(std::abs(moments.x), std::abs(moments.z));
  if (scale == 0) return {};
  return {-moments.x / scale, -eigenvalues(second_moments(I)).x / scale, scale};
}

}  // namespace

void check_inertias(const Structure& structure, const graph::Terms& terms,
                    const graph::Places& places, bool lenient, Report& report) {
  for (const Structure::Inertia& inertia : structure.inertias) {
    const Place place = places.find(inertia.coordinate);
    const std::string iri(terms.text(inertia.coordinate));
    const RigidBodyInertia& I = inertia.value;
    if (I.mass < 0) {
      report.error(place, iri, fmt::format("the mass is {} kg", I.mass), "give a positive mass");
      continue;
    }
    const Vector3& h = I.first_moment;
    if (I.mass == 0) {
      if (dot(h, h) > 0 || violation(I.rotational).largest > 0) {
        report.error(place, iri, "the link has no mass, but moments of it",
                     "give its mass, or leave its inertia out");
      }
      continue;
    }
    const Violation v = violation(about_centre_of_mass(I).rotational);
    if (v.moment > kTriangleWarning) {
      report.error(place, iri,
                   fmt::format("the inertia about the centre of mass has a negative moment, "
                               "{:.3g} kg m^2",
                               -v.moment * v.largest),
                   "give the moments and products of inertia of a real body");
    } else if (v.triangle > kTriangleError && !lenient) {
      report.error(
          place, iri,
          fmt::format("the moments of inertia violate the triangle inequality by {:.3g} of "
                      "the largest",
                      v.triangle),
          "each principal moment is at most the sum of the two others; correct them, or load "
          "leniently to compute with them as they are");
    } else if (v.triangle > kTriangleWarning) {
      report.warning(place, iri,
                     fmt::format("the moments of inertia violate the triangle inequality by {:.3g} "
                                 "of the largest",
                                 v.triangle),
                     "no real body has them; check the numbers");
    }
  }
}

void check_limits(const Structure& structure, const graph::Terms& terms,
                  const graph::Places& places, Report& report) {
  const auto check = [&](const JointLimits& l, graph::Id of) {
    const auto fault = [&](std::string what, std::string remedy) {
      report.error(places.find(of), std::string(terms.text(of)), std::move(what),
                   std::move(remedy));
    };
    if (l.lower > l.upper) {
      fault(fmt::format("the lower limit {} is above the upper limit {}", l.lower, l.upper),
            "exchange them");
    }
    if (l.maximum_velocity < 0 || l.maximum_force < 0) {
      fault("a velocity or force limit is negative", "give the largest size, without sign");
    }
  };
  for (const Structure::Joint& joint : structure.joints) {
    check(joint.limits, joint.iri);
    for (const Structure::Motion& motion : joint.motions)
      check(motion.limits, motion.iri ? motion.iri : joint.iri);
  }
}

}  // namespace sinew::model
