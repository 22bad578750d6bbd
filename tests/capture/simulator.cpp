// SPDX-License-Identifier: MIT
#include "capture/simulator.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "sateen/core/colour.h"
#include "sateen/core/direction.h"
#include "sateen/core/parallel.h"

namespace sateen::test {
namespace {

/// Evenly distributed in [0, 1), the same for the same cell everywhere.
double hash(int x, int y, int z, std::uint32_t seed) {
  auto h = static_cast<std::uint32_t>(x) * 0x9e3779b1u ^ static_cast<std::uint32_t>(y) * 0x85ebca77u ^
           static_cast<std::uint32_t>(z) * 0xc2b2ae3du ^ seed * 0x27d4eb2fu;
  h = (h ^ h >> 15) * 0x2c1b3c6du;
  h = (h ^ h >> 12) * 0x297a2d39u;
  return (h ^ h >> 15) / 4294967296.0;
}

/// Trilinear noise in [-1, 1] from a lattice that repeats after 64 cells.
double grain(const Vec3& p, std::uint32_t seed) {
  constexpr int kCells = 64;
  static const std::vector<float> lattice = [] {
    std::vector<float> values;
    for (int i = 0; i < kCells * kCells * kCells; ++i)
      values.push_back(static_cast<float>(2 * hash(i, 0, 0, 3) - 1));
    return values;
  }();
  const int shift = static_cast<int>(seed * 17);
  const int x = static_cast<int>(std::floor(p.x()));
  const int y = static_cast<int>(std::floor(p.y()));
  const int z = static_cast<int>(std::floor(p.z())) + shift;
  const auto fx = static_cast<float>(p.x() - x);
  const auto fy = static_cast<float>(p.y() - y);
  const auto fz = static_cast<float>(p.z() - (z - shift));
  const auto at = [&](int dx, int dy, int dz) {
    const int index = (((z + dz) & 63) * kCells + ((y + dy) & 63)) * kCells + ((x + dx) & 63);
    return lattice[static_cast<std::size_t>(index)];
  };
  const auto plane = [&](int dz) {
    const float top = at(0, 0, dz) + fx * (at(1, 0, dz) - at(0, 0, dz));
    const float bottom = at(0, 1, dz) + fx * (at(1, 1, dz) - at(0, 1, dz));
    return top + fy * (bottom - top);
  };
  return static_cast<double>(plane(0) + fz * (plane(1) - plane(0)));
}

Vec3 background(double x, double y) {
  const double wide = grain({x / 60, y / 60, 0}, 1);
  const double fine = grain({x / 7, y / 7, 0}, 2);
  const double line =
      std::fmod(x + 1000 + 20 * std::floor(y / 25), 40) < 2 || std::fmod(y + 1000, 25) < 2 ? 0.15 : 0;
  const double grey = 0.3 + 0.12 * wide + 0.05 * fine + line;
  return {grey, grey * 0.9, grey * 0.8};
}

}  // namespace

Vec3 Simulation::axis() const {
  const Vec3 to_eye = -capture::sphere_at(camera(), centre, radius).centre.normalized();
  const Mat3 to_view = eye_frame(to_eye).transpose();
  return to_view * Vec3(std::sin(radians(tilt.x())), std::sin(radians(tilt.y())), 1).normalized();
}

double Simulation::angle(int frame) const {
  while (std::ranges::find(repeated, frame) != repeated.end()) --frame;
  const double step = radians(turn) / frames;
  const double jitter = frame == 0 ? 0 : unevenness * (hash(frame, 3, 9, seed) - 0.5);
  return (clockwise ? -1 : 1) * step * (frame + jitter);
}

capture::SphereView Simulation::sphere_of(int frame) const {
  const capture::SphereView mean = capture::sphere_at(camera(), centre, radius);
  const Vec3 a = axis();
  // Across the axis: a pixel is 1 / radius of the sphere's radius.
  const Vec3 x = (Vec3::UnitX() - a * a.x()).normalized();
  const Vec3 y = a.cross(x);
  const Vec3 offset = (wobble.x() * x - wobble.y() * y) / radius;
  return {mean.centre + Eigen::AngleAxisd(angle(frame), a) * offset};
}

Vec3 Simulation::gain(int frame) const {
  const double g = 1 + drift * std::sin(0.37 * frame + 1) * std::cos(0.11 * frame);
  const double c = colour_drift * std::sin(0.2 * frame);
  return {g * (1 + c), g, g * (1 - c)};
}

bool Simulation::in_seam(const Vec3& body) const {
  if (!seam) return false;
  const Vec3 a = axis();
  const Vec3 x = (Vec3::UnitX() - a * a.x()).normalized();
  const double pole = radians(first_angle + 90);
  const double px = body.dot(x);
  const double py = body.dot(a.cross(x));
  const double off = std::remainder(std::atan2(py, px) - pole, 2 * kPi);
  return std::hypot(px, py) > 0.3 && std::abs(off) < radians(6);
}

Vec3 Simulation::material(const Vec3& n, const Vec3& t) const {
  const Vec3 light = Vec3(0.4, 0.6, 0.7).normalized();
  const Vec3 other = Vec3(-0.7, 0.1, 0.7).normalized();
  const Vec3 h1 = (light + Vec3::UnitZ()).normalized();
  const Vec3 h2 = (other + Vec3::UnitZ()).normalized();
  const Vec3 b = n.cross(t);
  const double warp = std::exp(-std::pow(t.dot(h1) / 0.3, 2)) * std::max(0.0, n.dot(light));
  const double weft = std::exp(-std::pow(b.dot(h2) / 0.35, 2)) * std::max(0.0, n.dot(other));
  const double diffuse = 0.5 * (1 + n.dot(light));
  const Vec3 light_out = exposure * (Vec3(0.14, 0.08, 0.12) * (0.4 + diffuse) + Vec3(0.5, 0.3, 0.12) * warp +
                                     Vec3(0.1, 0.3, 0.45) * weft);
  return grey ? Vec3(Vec3::Constant(light_out.y())) : light_out;
}

io::Picture8 Simulation::render(int frame) const {
  const capture::Camera lens = camera();
  const capture::SphereView ball = sphere_of(frame);
  const Vec3 a = axis();
  const Eigen::AngleAxisd turned(angle(frame), a);
  const Mat3 to_body = turned.toRotationMatrix().transpose();
  const Vec3 x_axis = (Vec3::UnitX() - a * a.x()).normalized();
  const Vec3 y_axis = a.cross(x_axis);
  const double pole_angle = radians(first_angle + 90) + angle(frame);
  const Vec3 pole = std::cos(pole_angle) * x_axis + std::sin(pole_angle) * y_axis;
  const Vec2 move = frame * 2 >= frames ? camera_move : Vec2(0, 0);
  const capture::SphereView twin =
      capture::sphere_at(lens, Vec2(centre.x() - 2.3 * radius, centre.y()), radius * 0.8);
  const Vec2 seen_centre = ball.centre_pixel(lens);
  const Vec2 twin_centre = twin.centre_pixel(lens);

  // Perspective makes the outline an ellipse: it lies between these distances from the centre.
  double inner = radius;
  double outer = radius;
  for (int i = 0; i < 32; ++i) {
    const double reach = (ball.outline_pixel(lens, 2 * kPi * i / 32) - seen_centre).norm();
    inner = std::min(inner, reach);
    outer = std::max(outer, reach);
  }

  const auto light_at = [&](const Vec2& at) -> Vec3 {
    const Vec2 pixel = at - move;
    Vec3 n;
    if (covered && std::abs(pixel.x() - centre.x()) < 7 && pixel.y() > centre.y() + 0.5 * radius) {
      return {0.4, 0.42, 0.4};
    }
    const bool near_ball = sphere && (pixel - seen_centre).norm() < outer + 3;
    const bool near_twin = second_sphere && (pixel - twin_centre).norm() < radius;
    if ((near_ball && capture::normal_at_pixel(lens, ball, pixel, n)) ||
        (near_twin && capture::normal_at_pixel(lens, twin, pixel, n))) {
      const Vec3 body = to_body * n;
      if (in_seam(body)) return {0.012, 0.012, 0.012};
      const Vec3 position = ball.centre + n;
      const Vec3 to_eye = -position.normalized();
      const Mat3 eye = eye_frame(to_eye);
      // Lamps at a finite distance see each point from another side: as if the normal leaned towards the
      // middle.
      const Vec3 lit =
          (n - Vec3(0.4, 0.6, 0.7) * (n.dot(Vec3(0.4, 0.6, 0.7)) - 1) / lamp_distance).normalized();
      const Vec3 tangent = pole.cross(lit).normalized();
      const double rough = 1 + texture * (grain(body * radius / 2.2, 11) + grain(body * radius / 5.0, 12));
      return material(eye * lit, eye * tangent) * rough;
    }
    if (stand && std::abs(pixel.x() - centre.x()) < 9 && pixel.y() > centre.y()) return {0.5, 0.5, 0.52};
    return background(pixel.x(), pixel.y());
  };

  // The background is the same in all frames of a size; drawing it once is what makes the simulator quick.
  static std::map<std::pair<int, int>, cv::Mat> backgrounds;
  cv::Mat& plain = backgrounds[{width, height}];
  if (plain.empty()) {
    plain.create(height, width, CV_32FC3);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Vec3 light = background(x + 0.5, y + 0.5);
        plain.at<cv::Vec3f>(y, x) = {static_cast<float>(light.x()), static_cast<float>(light.y()),
                                     static_cast<float>(light.z())};
      }
    }
  }
  const auto still = [&](int x, int y) -> cv::Vec3f {
    const double sx = x + 0.5 - move.x();
    const double sy = y + 0.5 - move.y();
    if (stand && std::abs(sx - centre.x()) < 9 && sy > centre.y()) return {0.5f, 0.5f, 0.52f};
    const int bx = std::clamp(static_cast<int>(sx), 0, width - 1);
    const int by = std::clamp(static_cast<int>(sy), 0, height - 1);
    return plain.at<cv::Vec3f>(by, bx);
  };
  static const std::vector<float> bells = [] {
    std::mt19937 random(5);
    std::normal_distribution<float> sensor(0, 1);
    std::vector<float> values(1 << 16);
    for (float& v : values) v = sensor(random);
    return values;
  }();
  static const std::vector<float> encode = [] {
    std::vector<float> values;
    for (int i = 0; i <= 8192; ++i) values.push_back(255 * srgb_encode(static_cast<float>(i) / 8192.0f));
    return values;
  }();

  cv::Mat image(height, width, CV_32FC3);
  parallel_for(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      Vec3 sum(0, 0, 0);
      const Vec2 p(x + 0.5, y + 0.5);
      const double from_centre = (p - move - seen_centre).norm();
      const bool fine =
          from_centre < outer + 3 || (second_sphere && (p - move - twin_centre).norm() < radius);
      const int n = fine ? (from_centre > inner - 3 ? 4 : samples) : 1;
      if (!fine) {
        image.at<cv::Vec3f>(y, x) = still(x, y);
        continue;
      }
      for (int v = 0; v < n; ++v) {
        for (int u = 0; u < n; ++u) sum += light_at({x + (u + 0.5) / n, y + (v + 0.5) / n});
      }
      sum /= n * n;
      image.at<cv::Vec3f>(y, x) = {static_cast<float>(sum.x()), static_cast<float>(sum.y()),
                                   static_cast<float>(sum.z())};
    }
  });
  const bool shake = std::ranges::find(shaken, frame) != shaken.end();
  const double sigma = std::hypot(blur, shake ? 4.0 : 0.0);
  if (sigma > 0) cv::GaussianBlur(image, image, {}, sigma);

  std::minstd_rand random(seed * 1000003u + static_cast<std::uint32_t>(frame) + 1);
  const bool dark = std::ranges::find(black, frame) != black.end();
  const Vec3 exposed = dark ? Vec3(0, 0, 0) : gain(frame);
  io::Picture8 picture;
  picture.width = width;
  picture.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double light = static_cast<double>(image.at<cv::Vec3f>(y, x)[c]) * exposed[c];
        double code =
            static_cast<double>(encode[static_cast<std::size_t>(std::clamp(light, 0.0, 1.0) * 8192)]);
        if (noise > 0) code += noise * static_cast<double>(bells[random() >> 8 & 0xffff]);
        picture.rgb.push_back(static_cast<std::uint8_t>(std::clamp(code + 0.5, 0.0, 255.0)));
      }
    }
  }
  return picture;
}

void Simulation::write(const std::filesystem::path& folder) const {
  for (int i = 0; i < frames; ++i) {
    io::Picture8 picture = render(i);
    cv::Mat rgb(height, width, CV_8UC3, picture.rgb.data());
    cv::Mat bgr;
    if (grey) {
      cv::extractChannel(rgb, bgr, 1);
    } else {
      cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    }
    cv::imwrite((folder / fmt::format("frame_{:03}.png", i)).string(), bgr, {cv::IMWRITE_PNG_COMPRESSION, 1});
  }
}

Simulation small_simulation(int frames) {
  Simulation s;
  s.width = 400;
  s.height = 240;
  s.focal = 780;
  s.centre = {215, 112};
  s.radius = 75;
  s.frames = frames;
  s.samples = 1;
  return s;
}

void write_video(const Simulation& s, const std::filesystem::path& path) {
  write_video(s, path, 0, s.frames);
}

void write_video(const Simulation& s, const std::filesystem::path& path, int first, int end) {
  cv::VideoWriter writer(path.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 24, {s.width, s.height});
  writer.set(cv::VIDEOWRITER_PROP_QUALITY, 97);
  for (int i = first; i < end; ++i) {
    io::Picture8 picture = s.render(i);
    cv::Mat bgr;
    cv::cvtColor(cv::Mat(s.height, s.width, CV_8UC3, picture.rgb.data()), bgr, cv::COLOR_RGB2BGR);
    writer.write(bgr);
  }
}

void draw_chessboard(const std::filesystem::path& path, const capture::Camera& camera, const Mat3& turned,
                     const Vec3& moved, int columns, int rows) {
  cv::Mat image(camera.height, camera.width, CV_8U);
  constexpr int kFine = 2;
  parallel_for(camera.height, [&](int y) {
    for (int x = 0; x < camera.width; ++x) {
      int white = 0;
      for (int i = 0; i < kFine * kFine; ++i) {
        const Vec3 ray = camera.ray({x + (i % kFine + 0.5) / kFine, y + (i / kFine + 0.5) / kFine});
        // Where the ray meets the board's plane, in the board's own coordinates.
        const Vec3 origin = turned.transpose() * -moved;
        const Vec3 d = turned.transpose() * ray;
        const Vec3 p = origin - d * (origin.z() / d.z());
        const double u = p.x() + (columns + 1) / 2.0;
        const double v = p.y() + (rows + 1) / 2.0;
        const bool on = u >= 0 && v >= 0 && u < columns + 1 && v < rows + 1;
        const bool dark = on && (static_cast<int>(u) + static_cast<int>(v)) % 2 == 0;
        white += dark ? 0 : 1;
      }
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(20 + 210 * white / (kFine * kFine));
    }
  });
  cv::imwrite(path.string(), image, {cv::IMWRITE_PNG_COMPRESSION, 1});
}

double table_psnr(const amc::AmcTable& table, const Simulation& truth,
                  const std::vector<std::uint8_t>& seen) {
  double squares = 0;
  double count = 0;
  for (int f = 0; f < table.slices; f += 3) {
    const double k = 2 * kPi * table.slice_angle(f);
    const Image slice = amc::slice_image(table, f);
    for (int y = 0; y < table.size; ++y) {
      for (int x = 0; x < table.size; ++x) {
        const Vec2 disc = disc_of_pixel(x, y, table.size);
        if (disc.norm() > 0.97) continue;
        const auto at = static_cast<std::size_t>((f * table.size + y) * table.size + x);
        if (!seen.empty() && seen[at] != 1) continue;
        const Vec3 n = normal_on_disc(disc);
        // The unit tangent across n whose picture-plane direction is k.
        const Vec2 d(std::cos(k), std::sin(k));
        const Vec3 t = Vec3(d.x(), d.y(), -n.head<2>().dot(d) / n.z()).normalized();
        const Vec3 wanted = truth.material(n, t);
        squares += (slice.rgb(x, y).cast<double>() - wanted).squaredNorm();
        count += 3;
      }
    }
  }
  return -10 * std::log10(squares / count);
}

}  // namespace sateen::test
