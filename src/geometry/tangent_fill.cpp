// SPDX-License-Identifier: MIT
#include "sateen/geometry/tangent_fill.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "sateen/core/direction.h"
#include "sateen/geometry/weld.h"

namespace sateen::geometry {
namespace {

using Link = std::pair<std::uint32_t, std::uint32_t>;  // (vertex to fill, neighbour)

// Links from the vertices to fill to everything around them, sorted by the first.
std::vector<Link> links_to_fill(const Mesh& mesh, const std::vector<char>& known) {
  std::vector<Link> links;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (known[triangle[c]]) continue;
      links.emplace_back(triangle[c], triangle[(c + 1) % 3]);
      links.emplace_back(triangle[c], triangle[(c + 2) % 3]);
    }
  }
  const std::vector<std::uint32_t> weld = weld_positions(mesh.positions);
  std::vector<Link> copies;  // (position, vertex)
  std::vector<char> wanted(weld.size());
  for (std::uint32_t i = 0; i < weld.size(); ++i) {
    if (!known[i]) wanted[weld[i]] = 1;
  }
  for (std::uint32_t i = 0; i < weld.size(); ++i) {
    if (wanted[weld[i]]) copies.emplace_back(weld[i], i);
  }
  std::ranges::sort(copies);
  // A chain through the copies of a position is enough to pass a tangent on.
  for (std::size_t i = 1; i < copies.size(); ++i) {
    if (copies[i].first != copies[i - 1].first) continue;
    if (!known[copies[i].second]) links.emplace_back(copies[i].second, copies[i - 1].second);
    if (!known[copies[i - 1].second]) links.emplace_back(copies[i - 1].second, copies[i].second);
  }
  std::ranges::sort(links);
  return links;
}

// The tangent a vertex takes from its neighbours of earlier rounds; false when it has none.
bool take_from_neighbours(Mesh& mesh, std::uint32_t vertex, std::span<const Link> links,
                          const std::vector<int>& round, int now) {
  const Vec3 normal = mesh.normals[vertex].cast<double>();
  Vec3 sum = Vec3::Zero();
  Vec3 one = Vec3::Zero();
  float w = 0;
  for (const Link& link : links) {
    if (round[link.second] < 0 || round[link.second] >= now) continue;
    const Vec3 tangent = across(mesh.tangents[link.second].head<3>().cast<double>(), normal);
    sum += tangent;
    w += mesh.tangents[link.second].w();
    if (tangent.norm() > one.norm() + 1e-6) one = tangent;
  }
  const Vec3& chosen = sum.norm() > 0.1 ? sum : one;
  if (chosen.norm() < 1e-3) return false;
  const Vec3 unit = across(chosen.normalized(), normal).normalized();
  mesh.tangents[vertex] << unit.cast<float>(), w < 0 ? -1.0f : 1.0f;
  return true;
}

}  // namespace

void fill_tangents(Mesh& mesh, const std::vector<char>& known) {
  if (std::ranges::all_of(known, [](char k) { return k != 0; })) return;
  const bool some = std::ranges::any_of(known, [](char k) { return k != 0; });
  const std::vector<Link> links = some ? links_to_fill(mesh, known) : std::vector<Link>();
  const auto links_of = [&](std::uint32_t vertex) {
    const auto begin = std::ranges::lower_bound(links, vertex, {}, &Link::first);
    return std::span<const Link>(begin,
                                 std::ranges::upper_bound(begin, links.end(), vertex, {}, &Link::first));
  };
  // round[i]: when a vertex got its tangent, 0 for the known ones, -1 for those still without.
  std::vector<int> round(known.size());
  std::ranges::transform(known, round.begin(), [](char k) { return k ? 0 : -1; });

  std::vector<std::uint32_t> front;
  for (const Link& link : links) {
    if (round[link.second] == 0 && (front.empty() || front.back() != link.first)) front.push_back(link.first);
  }
  for (int now = 1; !front.empty(); ++now) {
    std::vector<std::uint32_t> filled;
    for (const std::uint32_t vertex : front) {
      if (round[vertex] < 0 && take_from_neighbours(mesh, vertex, links_of(vertex), round, now)) {
        round[vertex] = now;
        filled.push_back(vertex);
      }
    }
    front.clear();
    for (const std::uint32_t vertex : filled) {
      for (const Link& link : links_of(vertex)) {
        if (round[link.second] < 0) front.push_back(link.second);
      }
    }
    std::ranges::sort(front);
    front.erase(std::unique(front.begin(), front.end()), front.end());
  }
  for (std::size_t i = 0; i < round.size(); ++i) {
    if (round[i] >= 0) continue;
    Vec3 tangent;
    Vec3 bitangent;
    frame_around(mesh.normals[i].cast<double>(), tangent, bitangent);
    mesh.tangents[i] << tangent.cast<float>(), 1.0f;
  }
}

}  // namespace sateen::geometry
