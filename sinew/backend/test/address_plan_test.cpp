#include "sinew/backend/jit/address_plan.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace {

using sinew::backend::address_of;
using sinew::backend::AddressPlan;
using sinew::backend::plan_addresses;
using sinew::backend::PlannedAddress;

constexpr std::int32_t kNear = 16;  // doubles within 128 bytes

std::vector<std::uint32_t> whole_matrix(std::uint32_t rows) {
  std::vector<std::uint32_t> places(rows * rows);
  std::iota(places.begin(), places.end(), 0u);
  return places;
}

// Of a humanoid's mass matrix: rows and columns of the base and the trunk, and blocks of limbs.
std::vector<std::uint32_t> mass_matrix(std::uint32_t rows, std::uint32_t trunk,
                                       std::uint32_t limb) {
  std::vector<std::uint32_t> places;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < rows; ++column) {
      const bool same =
          row >= trunk && column >= trunk && (row - trunk) / limb == (column - trunk) / limb;
      if (row < trunk || column < trunk || same) places.push_back(row * rows + column);
    }
  }
  return places;
}

// The place that an address leads to.
std::int32_t target(const AddressPlan& plan, const PlannedAddress& address) {
  const std::int32_t index =
      address.scale == 0 ? 0
                         : static_cast<std::int32_t>(address.scale) * plan.indices[address.index];
  return plan.bases[address.base] + index + address.distance;
}

bool is_near(const PlannedAddress& address) {
  return -kNear <= address.distance && address.distance < kNear;
}

std::size_t count_near(const AddressPlan& plan, const std::vector<std::uint32_t>& places) {
  std::size_t count = 0;
  for (const std::uint32_t place : places) count += is_near(address_of(plan, kNear, place)) ? 1 : 0;
  return count;
}

TEST(AddressPlan, WhatOneRegisterReachesNeedsNoOther) {
  std::vector<std::uint32_t> places(32);
  std::iota(places.begin(), places.end(), 0u);
  const AddressPlan plan = plan_addresses(places, kNear, 8);
  EXPECT_EQ(plan.bases.size(), 1u);
  EXPECT_TRUE(plan.indices.empty());
  EXPECT_EQ(count_near(plan, places), places.size());
}

TEST(AddressPlan, NoResultsNeedOneBaseAtTheBeginning) {
  const AddressPlan plan = plan_addresses({}, kNear, 8);
  EXPECT_EQ(plan.bases, std::vector<std::int32_t>{0});
  EXPECT_TRUE(plan.indices.empty());
}

TEST(AddressPlan, FewFarPlacesAreNotWorthARegister) {
  std::vector<std::uint32_t> places(32);
  std::iota(places.begin(), places.end(), 0u);
  for (const std::uint32_t far : {1000u, 1001u, 1002u, 1003u}) places.push_back(far);
  const AddressPlan plan = plan_addresses(places, kNear, 8);
  EXPECT_EQ(plan.bases.size() + plan.indices.size(), 1u);
  EXPECT_EQ(count_near(plan, places), 32u);
}

TEST(AddressPlan, AddressesLeadToTheirPlaces) {
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    std::set<std::uint32_t> chosen;
    for (int k = 0; k < 200; ++k) chosen.insert(random() % 1500);
    const std::vector<std::uint32_t> places(chosen.begin(), chosen.end());
    const AddressPlan plan = plan_addresses(places, kNear, 1 + round % 8);
    for (const std::uint32_t place : places) {
      EXPECT_EQ(target(plan, address_of(plan, kNear, place)), static_cast<std::int32_t>(place));
    }
  }
}

TEST(AddressPlan, TakesNoMoreRegistersThanThereAre) {
  const std::vector<std::uint32_t> places = whole_matrix(36);
  for (std::size_t registers = 1; registers <= 8; ++registers) {
    const AddressPlan plan = plan_addresses(places, kNear, registers);
    EXPECT_LE(plan.bases.size() + plan.indices.size(), registers);
  }
}

TEST(AddressPlan, MoreRegistersBringNoFewerPlacesNear) {
  const std::vector<std::uint32_t> places = mass_matrix(36, 9, 7);
  std::size_t before = 0;
  for (std::size_t registers = 1; registers <= 8; ++registers) {
    const std::size_t near = count_near(plan_addresses(places, kNear, registers), places);
    EXPECT_GE(near, before) << registers;
    before = near;
  }
}

TEST(AddressPlan, SevenRegistersReachMostOfAMassMatrix) {
  const std::vector<std::uint32_t> places = mass_matrix(36, 8, 7);
  const AddressPlan plan = plan_addresses(places, kNear, 7);
  EXPECT_GT(10 * count_near(plan, places), 8 * places.size());
}

}  // namespace
