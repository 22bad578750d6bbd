// SPDX-License-Identifier: MIT
#include "sateen/matcap/sphere_disc.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "sateen/core/error.h"

namespace sateen::matcap {
namespace {

constexpr double kMinRadius = 2;           // pixels
constexpr double kNearlyInscribed = 0.02;  // of the radius: closer than that is taken as the inscribed disc
constexpr int kRays = 256;                 // directions in which the silhouette is looked for

bool alpha_varies(const Image& image) {
  if (image.channels != 2 && image.channels != 4) return false;
  const int c = image.channels - 1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y, c) < 0.5F) return true;
    }
  }
  return false;
}

/// Whether a pixel is the sphere and not what is behind it; nothing when the background is not of one colour.
std::optional<std::vector<char>> foreground(const Image& image) {
  std::vector<char> mask(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const auto at = [&](int x, int y) -> char& {
    return mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                static_cast<std::size_t>(x)];
  };
  if (alpha_varies(image)) {
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) at(x, y) = image.at(x, y, image.channels - 1) >= 0.5F ? 1 : 0;
    }
    return mask;
  }
  const Vec3f background = image.rgb(0, 0);
  const float tolerance = 0.02F + 0.05F * background.cwiseAbs().maxCoeff();
  const auto differs = [&](int x, int y) {
    return (image.rgb(x, y) - background).cwiseAbs().maxCoeff() > tolerance;
  };
  const int corner_x = std::max(1, image.width / 20);
  const int corner_y = std::max(1, image.height / 20);
  for (int y = 0; y < corner_y; ++y) {
    for (int x = 0; x < corner_x; ++x) {
      const int across = image.width - 1 - x;
      const int below = image.height - 1 - y;
      if (differs(x, y) || differs(across, y) || differs(x, below) || differs(across, below))
        return std::nullopt;
    }
  }
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) at(x, y) = differs(x, y) ? 1 : 0;
  }
  return mask;
}

/// Silhouette points seen from outside: along rays towards the picture's middle, where the foreground starts.
std::vector<Vec2> silhouette(const std::vector<char>& mask, int width, int height) {
  Vec2 centre(0, 0);
  double count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] ==
          0)
        continue;
      centre += Vec2(x + 0.5, y + 0.5);
      ++count;
    }
  }
  std::vector<Vec2> points;
  if (count == 0) return points;
  centre /= count;
  const double reach = std::hypot(width, height);
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2 * kPi * i / kRays;
    const Vec2 direction(std::cos(angle), std::sin(angle));
    for (double t = reach; t > 0; t -= 0.25) {
      const Vec2 p = centre + t * direction;
      const int x = static_cast<int>(std::floor(p.x()));
      const int y = static_cast<int>(std::floor(p.y()));
      if (x < 0 || y < 0 || x >= width || y >= height) continue;
      if (mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] !=
          0) {
        points.push_back(p);
        break;
      }
    }
  }
  return points;
}

/// Least-squares circle through points, the worst left out: a dark part of the rim on a dark background lies
/// inside.
std::optional<Disc> fit_circle(std::vector<Vec2> points) {
  Disc disc;
  for (int pass = 0; pass < 12; ++pass) {
    if (points.size() < kRays / 4) return std::nullopt;
    Eigen::MatrixXd a(static_cast<Eigen::Index>(points.size()), 3);
    Eigen::VectorXd b(a.rows());
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      const Vec2& p = points[static_cast<std::size_t>(i)];
      a.row(i) << 2 * p.x(), 2 * p.y(), 1;
      b[i] = p.squaredNorm();
    }
    const Vec3 s = (a.transpose() * a).ldlt().solve(a.transpose() * b);
    disc = {s.x(), s.y(), std::sqrt(std::max(0.0, s.z() + s.x() * s.x() + s.y() * s.y()))};
    const auto error = [&](const Vec2& p) {
      return std::abs((p - Vec2(disc.x, disc.y)).norm() - disc.radius);
    };
    const double worst = error(*std::ranges::max_element(points, {}, error));
    if (worst < std::max(1.0, 0.01 * disc.radius)) return disc;
    std::erase_if(points, [&](const Vec2& p) { return error(p) > 0.6 * worst; });
  }
  return std::nullopt;
}

}  // namespace

Disc inscribed_disc(int width, int height) {
  return {width / 2.0, height / 2.0, std::min(width, height) / 2.0};
}

void check_disc(const Disc& disc, int width, int height, const std::string& name) {
  if (!(disc.radius >= kMinRadius)) {
    throw Error(fmt::format("{}: the sphere has a radius of {:.3g} pixels; at least {} are needed", name,
                            disc.radius, kMinRadius));
  }
  const double out = std::max({disc.radius - disc.x, disc.radius - disc.y, disc.x + disc.radius - width,
                               disc.y + disc.radius - height});
  if (!(out <= 0.5)) {
    throw Error(
        fmt::format("{}: a sphere at ({:.6g}, {:.6g}) of radius {:.6g} does not fit into {} x {} pixels",
                    name, disc.x, disc.y, disc.radius, width, height));
  }
}

Disc find_disc(const Image& image, const std::string& name) {
  const Disc inscribed = inscribed_disc(image.width, image.height);
  check_disc(inscribed, image.width, image.height, name);
  std::optional<Disc> found;
  if (const auto mask = foreground(image)) found = fit_circle(silhouette(*mask, image.width, image.height));
  if (found) {
    const double off = std::max({std::abs(found->x - inscribed.x), std::abs(found->y - inscribed.y),
                                 std::abs(found->radius - inscribed.radius)});
    const bool fits = found->x - found->radius > -1 && found->y - found->radius > -1 &&
                      found->x + found->radius < image.width + 1 &&
                      found->y + found->radius < image.height + 1;
    if (image.width == image.height && off < kNearlyInscribed * inscribed.radius) return inscribed;
    if (fits && found->radius >= kMinRadius) {
      found->radius = std::min({found->radius, found->x + 0.5, found->y + 0.5, image.width - found->x + 0.5,
                                image.height - found->y + 0.5});
      return *found;
    }
  }
  if (image.width != image.height) {
    throw Error(fmt::format(
        "{}: {} x {} pixels and no sphere found before a plain background; a MatCap is square, or "
        "say where the sphere is (disc x,y,r in pixels)",
        name, image.width, image.height));
  }
  return inscribed;
}

}  // namespace sateen::matcap
