// SPDX-License-Identifier: MIT
#include "sateen/capture/capture.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "sateen/capture/angles.h"
#include "sateen/capture/choose_camera.h"
#include "sateen/capture/measure.h"
#include "sateen/capture/mirror_ball.h"
#include "sateen/capture/weave.h"
#include "sateen/capture/wobble.h"
#include "sateen/core/direction.h"
#include "sateen/core/error.h"
#include "sateen/io/image.h"

namespace sateen {
namespace {

constexpr double kRegistrationNoise = radians(0.25);
constexpr int kEnvironmentWidth = 512;
constexpr const char* kNoAngle = "its angle cannot be found";
constexpr int kSymmetrySlices = 48;  // divisible by 2, 3 and 4

double median(std::vector<double> values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, half);
  return *half;
}

class Builder {
 public:
  Builder(const std::vector<std::filesystem::path>& inputs, const CaptureOptions& options)
      : options_(options), source_(FrameSource::open(inputs, options.source)) {}

  CaptureResult run() {
    check_count();
    result_.camera = choose_camera(source_, options_);
    look_ = first_look(source_, result_.camera, stage(0, 0.1));
    axes_ = eye_frame(-sphere_at(look_.camera, look_.centre, look_.outline.radius).centre.normalized());
    notes_ = measure_frames(source_, look_, axes_, stage(0.1, 0.45));
    drop_unread();
    find_angles();
    check_turn();
    find_wobble();
    find_photometry();
    rectify_frames();
    fix_zero();
    make_table();
    if (!options_.mirror_ball.empty()) read_mirror_ball();
    warn_of_framing();
    for (const std::string& warning : source_.warnings()) result_.warnings.push_back(warning);
    return std::move(result_);
  }

 private:
  Progress stage(double from, double to) const {
    if (!options_.progress) return {};
    return [this, from, to](double f) { options_.progress(from + (to - from) * f); };
  }

  void check_count() const {
    if (source_.count() >= kFewestCaptureFrames) return;
    throw Error(fmt::format("only {} frames given; a turn needs at least {}, better 64 or more",
                            source_.count(), kFewestCaptureFrames));
  }

  void drop_unread() {
    while (!notes_.empty() && !notes_.back().read) notes_.pop_back();
    check_count();
    result_.frames.resize(notes_.size());
    std::vector<double> sharpness;
    for (const FrameNotes& note : notes_) sharpness.push_back(note.patch.sharpness);
    const double typical = std::max(1e-9, median(sharpness));
    for (std::size_t i = 0; i < notes_.size(); ++i) {
      CaptureFrame& frame = result_.frames[i];
      frame.file = source_.name(static_cast<int>(i));
      frame.sharpness = sharpness[i] / typical;
      // Shading changes the detail slowly along the turn: blur stands out against the frames around.
      std::vector<double> near;
      for (std::size_t j = i > 4 ? i - 4 : 0; j < std::min(notes_.size(), i + 5); ++j)
        near.push_back(sharpness[j]);
      if (sharpness[i] < 0.6 * median(near)) frame.dropped = "blurred";
    }
  }

  std::vector<std::size_t> used() const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < result_.frames.size(); ++i) {
      if (result_.frames[i].dropped.empty()) indices.push_back(i);
    }
    return indices;
  }

  void find_angles() {
    const std::vector<std::size_t> indices = used();
    if (indices.size() < static_cast<std::size_t>(kFewestCaptureFrames)) {
      throw Error(
          fmt::format("only {} of {} frames are sharp enough to be used", indices.size(), notes_.size()));
    }
    std::vector<SurfacePatch> patches;
    std::vector<double> known;
    for (const std::size_t i : indices) {
      patches.push_back(std::move(notes_[i].patch));
      if (options_.angle_source == AngleSource::equal) {
        known.push_back((options_.clockwise ? -1 : 1) * 2 * kPi * static_cast<double>(i) /
                        static_cast<double>(notes_.size()));
      }
      if (options_.angle_source == AngleSource::given) {
        if (options_.angles.size() != notes_.size()) {
          throw Error(
              fmt::format("{} angles are given for {} frames", options_.angles.size(), notes_.size()));
        }
        known.push_back(options_.angles[i]);
      }
    }
    Turning turning = known.empty() ? find_turning(patches, axes_) : find_axis(patches, axes_, known, false);
    if (known.empty()) {
      const double trust = median(turning.confidence);
      if (trust < 1.3 * turning.confidence_floor) {
        throw Error(
            "the turning cannot be followed: the surface shows no detail (weave, grain, a seam) sharp "
            "enough. Stick a few "
            "small marks on it outside the part that counts, or say how it turned: --angles equal or "
            "--angles FILE");
      }
    }
    result_.axis = turning.axis;
    for (std::size_t k = 0; k < indices.size(); ++k) {
      CaptureFrame& frame = result_.frames[indices[k]];
      frame.turned = turning.angles[k];
      frame.confidence = turning.confidence[k];
      // Against the surface all frames share, blur shows even where noise hides it; the light changes this
      // slowly.
      const auto here = turning.strength.begin() + static_cast<std::ptrdiff_t>(k);
      const auto before = here - static_cast<std::ptrdiff_t>(std::min<std::size_t>(k, 4));
      const auto after = here + static_cast<std::ptrdiff_t>(std::min<std::size_t>(indices.size() - k, 5));
      if (known.empty() && turning.strength[k] < 0.55 * median({before, after})) frame.dropped = "blurred";
      if (known.empty() && turning.confidence[k] < turning.confidence_floor) frame.dropped = kNoAngle;
    }
    if (known.empty()) recognise_equal_steps();
    drop_duplicates();
    // Angles count from the first frame that is used.
    const double first = result_.frames[used().front()].turned;
    for (CaptureFrame& frame : result_.frames) frame.turned = wrap(frame.turned - first, 2 * kPi);
    std::vector<double> turned;
    for (const std::size_t i : used()) turned.push_back(result_.frames[i].turned);
    result_.turned = unwrapped(turned).back();
  }

  void recognise_equal_steps() {
    std::vector<int> places;
    std::vector<double> angles;
    for (const std::size_t i : used()) {
      places.push_back(static_cast<int>(i));
      angles.push_back(result_.frames[i].turned);
    }
    const EqualSteps steps = equal_steps(places, angles, static_cast<int>(notes_.size()), kRegistrationNoise);
    if (!steps.found) return;
    result_.equal_steps = true;
    for (std::size_t i = 0; i < result_.frames.size(); ++i) {
      result_.frames[i].turned = steps.first + steps.step * static_cast<double>(i);
      if (result_.frames[i].dropped == kNoAngle) result_.frames[i].dropped.clear();
    }
  }

  void drop_duplicates() {
    const std::vector<std::size_t> indices = used();
    if (indices.size() < 2) return;
    std::vector<double> steps;
    for (std::size_t k = 1; k < indices.size(); ++k) {
      steps.push_back(std::abs(std::remainder(
          result_.frames[indices[k]].turned - result_.frames[indices[k - 1]].turned, 2 * kPi)));
    }
    const double typical = median(steps);
    std::size_t kept = indices[0];
    for (std::size_t k = 1; k < indices.size(); ++k) {
      CaptureFrame& frame = result_.frames[indices[k]];
      const double step = std::abs(std::remainder(frame.turned - result_.frames[kept].turned, 2 * kPi));
      if (step < 0.1 * typical) {
        frame.dropped = "shows the same angle as the frame before";
      } else {
        kept = indices[k];
      }
    }
  }

  void check_turn() {
    std::vector<double> angles;
    for (const std::size_t i : used()) angles.push_back(result_.frames[i].turned);
    if (angles.size() < static_cast<std::size_t>(kFewestCaptureFrames)) {
      throw Error(fmt::format(
          "only {} of {} frames can be used; the others are blurred, repeated or not to be registered",
          angles.size(), notes_.size()));
    }
    const double period = 2 * kPi / options_.symmetry.value_or(1);
    const Coverage found = coverage(angles, period);
    const double even = period / static_cast<double>(angles.size());
    if (found.widest > std::max(radians(25), 3.5 * even)) {
      throw Error(
          fmt::format("the turn is not complete: the frames cover {:.0f} of {:.0f} degrees and leave a gap "
                      "of {:.0f}. Turn the sphere "
                      "all the way round; if it did, its surface shows too little detail to follow: say how "
                      "it turned with --angles",
                      degrees(period - found.widest + found.median), degrees(period), degrees(found.widest)));
    }
    if (found.widest > std::max(radians(10), 2.5 * even)) {
      result_.warnings.push_back(
          fmt::format("between two frames the sphere turned by {:.0f} degrees: the material is interpolated "
                      "there. Turn it more evenly",
                      degrees(found.widest)));
    }
  }

  void find_wobble() {
    const double factor = look_.factor;
    std::vector<Vec2> centres;
    std::vector<double> angles;
    double support = 0;
    const std::vector<std::size_t> indices = used();
    for (const std::size_t i : indices) {
      centres.push_back(notes_[i].centre * factor);
      angles.push_back(result_.frames[i].turned);
      support += notes_[i].support / static_cast<double>(indices.size());
    }
    const Wobble wobble = fit_wobble(centres, angles);
    result_.wobble = std::sqrt((wobble.cosine.squaredNorm() + wobble.sine.squaredNorm()) / 2);
    result_.wobble_rms = wobble.rms;
    result_.outline_support = support;
    const double radius = look_.outline.radius * factor;
    const bool circular = wobble.rms < 0.4 * factor;
    for (std::size_t i = 0; i < result_.frames.size(); ++i) {
      CaptureFrame& frame = result_.frames[i];
      frame.radius = radius;
      frame.centre =
          circular && frame.dropped.empty() ? wobble.at(frame.turned) : Vec2(notes_[i].centre * factor);
    }
    result_.sphere = sphere_at(result_.camera, wobble.middle, radius);
    if (!circular) {
      result_.warnings.push_back(
          fmt::format("the sphere does not turn about a fixed axis (its picture strays by {:.1f} pixels from "
                      "a circle): the stand may "
                      "have been touched. Each frame was measured alone",
                      wobble.rms));
    }
    if (support < 0.5) {
      result_.warnings.push_back(
          fmt::format("only {:.0f} % of the outline stands out against the background: put something plain "
                      "behind the sphere",
                      100 * support));
    }
  }

  void find_photometry() {
    std::vector<std::vector<Vec3f>> samples;
    for (FrameNotes& note : notes_) samples.push_back(std::move(note.still));
    result_.photometry = solve_photometry(samples, look_.still, source_.height());
    const Photometry& photometry = result_.photometry;
    for (std::size_t i = 0; i < result_.frames.size(); ++i) result_.frames[i].gain = photometry.gain[i];
    if (!photometry.measured) {
      result_.warnings.push_back(
          "too little of the picture stands still and is lit, so exposure drift was not removed. Leave some "
          "lit background "
          "around the sphere, or fix the camera's exposure");
    }
    if (photometry.drift > 0.15) {
      result_.warnings.push_back(
          fmt::format("the exposure changes by up to {:.0f} %: the light flickers or the camera adapts. It "
                      "was removed; fix exposure and "
                      "white balance for less noise",
                      100 * photometry.drift));
    }
    if (photometry.banding > 0.02) {
      result_.warnings.push_back(fmt::format(
          "the upper and lower half of the picture flicker apart by {:.1f} %: a lamp pulses faster than the "
          "camera reads a "
          "frame. Use a flicker-free lamp or an exposure of a whole mains period (1/50 or 1/60 s)",
          100 * photometry.banding));
    }
  }

  /// A stand in front of the sphere does not turn: it is no more active than the background.
  void hide_what_stands_still(const RectifyMap& map) {
    const int size = options_.size;
    const int width = look_.camera.width;
    std::vector<std::size_t> still;
    double inside = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec2 disc = disc_of_pixel(x, y, size);
        const Vec2 p = map.pixel(x, y) / look_.factor;
        if (disc.norm() > 0.96 || p.x() < 2) continue;
        ++inside;
        // The quietest of a plus of pixels would be chance; the loudest has to be quiet.
        float loudest = 0;
        for (const auto& [u, v] : {std::pair{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
          const auto i =
              (static_cast<std::ptrdiff_t>(p.y()) + v) * width + static_cast<std::ptrdiff_t>(p.x()) + u;
          loudest = std::max(loudest, look_.scouting.activity[static_cast<std::size_t>(i)]);
        }
        if (static_cast<double>(loudest) < 2 * look_.scouting.noise)
          still.push_back(static_cast<std::size_t>(y * size + x));
      }
    }
    const double share = static_cast<double>(still.size()) / std::max(1.0, inside);
    if (share < 0.003) return;
    if (share > 0.25) {
      result_.warnings.push_back(fmt::format(
          "{:.0f} % of the sphere hardly changes as it turns: it is plain there, very dark, or covered",
          100 * share));
      return;
    }
    for (const std::size_t i : still) stack_.points[i].visible = false;
    result_.warnings.push_back(
        fmt::format("{:.1f} % of the sphere stands still, as behind a stand, and was filled from its "
                    "neighbours: keep the front clear",
                    100 * share));
  }

  void rectify_frames() {
    const double rim = 1.5 * look_.factor;
    const RectifyMap map(result_.camera, result_.sphere, options_.size, options_.frame, rim);
    stack_.size = options_.size;
    stack_.axis = result_.axis;
    stack_.frame = options_.frame;
    for (int y = 0; y < options_.size; ++y) {
      for (int x = 0; x < options_.size; ++x) stack_.points.push_back(map.point(x, y));
    }
    hide_what_stands_still(map);
    std::vector<int> indices;
    for (const std::size_t i : used()) indices.push_back(static_cast<int>(i));
    std::ranges::sort(indices);
    result_.preview_frame = indices.front();
    std::vector<RectifiedFrame> frames(notes_.size());
    std::atomic<int> done = 0;
    const Progress progress = stage(0.5, 0.9);
    const int first = result_.preview_frame;
    source_.visit(indices, [&](int index, const Frame& frame) {
      const CaptureFrame& known = result_.frames[static_cast<std::size_t>(index)];
      frames[static_cast<std::size_t>(index)] = rectify(map, frame, known.centre, known.gain);
      if (index == first) keep_preview(frame);
      report(progress, static_cast<double>(++done) / static_cast<double>(indices.size()));
    });
    std::ranges::sort(indices, {}, [&](int i) { return result_.frames[static_cast<std::size_t>(i)].turned; });
    double clipped = 0;
    double samples = 0;
    result_.clipped = Image(options_.size, options_.size, 1);
    const float share = 1 / static_cast<float>(indices.size());
    for (const int i : indices) {
      RectifiedFrame& frame = frames[static_cast<std::size_t>(i)];
      if (frame.weight.empty()) continue;
      for (std::size_t t = 0; t < frame.weight.size(); ++t) {
        samples += frame.weight[t] > 0 ? 1 : 0;
        if (frame.clipped[t] <= 127) continue;
        ++clipped;
        result_.clipped.data[t] += share;
      }
      stack_.frames.push_back(std::move(frame));
      stack_.angles.push_back(result_.frames[static_cast<std::size_t>(i)].turned);
    }
    result_.clipped_share = samples > 0 ? clipped / samples : 0;
    if (result_.clipped_share > 0.01) {
      result_.warnings.push_back(
          fmt::format("{:.1f} % of the material is clipped: highlights will look flat. Expose shorter, or "
                      "bracket exposures",
                      100 * result_.clipped_share));
    }
    if (!options_.mask.empty()) read_painted_mask();
    if (options_.find_blemishes) find_seams();
  }

  void keep_preview(const Frame& frame) {
    const int factor = (frame.width() + 959) / 960;
    const Image whole = frame.crop(0, 0, frame.width() / factor * factor, frame.height() / factor * factor);
    result_.preview = resized(whole, whole.width / factor, whole.height / factor);
  }

  void read_painted_mask() {
    const Image painting = read_data(options_.mask);
    if (painting.width != source_.width() || painting.height != source_.height()) {
      throw Error(fmt::format("{}: is {} x {}, the frames are {} x {}", options_.mask.string(),
                              painting.width, painting.height, source_.width(), source_.height()));
    }
    if (options_.mask_frame < 0 || options_.mask_frame >= static_cast<int>(result_.frames.size())) {
      throw Error(fmt::format("the mask is said to be painted on frame {}, there are {}", options_.mask_frame,
                              result_.frames.size()));
    }
    const CaptureFrame& frame = result_.frames[static_cast<std::size_t>(options_.mask_frame)];
    result_.mask =
        mask_from_painting(painting, result_.camera, sphere_at(result_.camera, frame.centre, frame.radius),
                           result_.axis, frame.turned, options_.size);
  }

  void find_seams() {
    SurfaceMask found = find_blemishes(stack_, result_.mask);
    // Once more without what was found, so that it no longer pulls the medians.
    if (found.share > 0) found = find_blemishes(stack_, united(result_.mask, found));
    if (found.share > 0.4) {
      result_.warnings.push_back(
          fmt::format("the surface is so uneven that {:.0f} % of it would count as seam; nothing was masked. "
                      "Paint a mask on one frame "
                      "(--mask) if there is a seam",
                      100 * found.share));
      return;
    }
    result_.mask = united(found, result_.mask);
  }

  void fix_zero() {
    first_angle_ = options_.zero_angle;
    switch (options_.zero) {
      case ZeroAngle::first_frame:
        result_.zero_source =
            options_.zero_given ? "angle of the first frame given" : "not given: first frame is 0";
        if (!options_.zero_given) {
          result_.warnings.push_back(
              "the tangent's direction is unknown, so the first frame's was called 0 degrees. Give "
              "--first-angle, or "
              "--thread-direction read off a picture, or --tangent-from-seam when the cloth is sewn at a "
              "pole");
        }
        break;
      case ZeroAngle::thread: {
        const auto count = static_cast<int>(result_.frames.size());
        if (options_.zero_frame < 0 || options_.zero_frame >= count) {
          throw Error(
              fmt::format("the thread is read off frame {}, there are {}", options_.zero_frame, count));
        }
        first_angle_ -= result_.frames[static_cast<std::size_t>(options_.zero_frame)].turned;
        result_.zero_source = "thread direction read off a frame";
        break;
      }
      case ZeroAngle::seam: {
        double direction = 0;
        if (!mask_direction(result_.mask, direction)) {
          throw Error(
              "no seam found to one side of the sphere's middle, so the tangent cannot be taken from it; "
              "paint it on one "
              "frame (--mask) or give --first-angle");
        }
        first_angle_ += direction;
        result_.zero_source =
            fmt::format("seam found at {:.1f} degrees in the first frame", degrees(direction));
        break;
      }
      case ZeroAngle::weave: {
        double direction = 0;
        if (!weave_direction(stack_, direction)) {
          throw Error(
              "no weave is visible to take the tangent from; give --first-angle or --thread-direction");
        }
        first_angle_ += direction;
        result_.zero_source =
            fmt::format("weave found at {:.1f} degrees in the first frame", degrees(direction));
        break;
      }
    }
    for (CaptureFrame& frame : result_.frames) frame.angle = wrap(first_angle_ + frame.turned, 2 * kPi);
  }

  /// What a seam hid says nothing about symmetry: there the slice half a turn on stands in, which for R = 2
  /// and 4 is as good as leaving it out.
  void take_unseen_from_opposite(AssembledSlices& whole) const {
    const auto texels = static_cast<std::size_t>(options_.size) * static_cast<std::size_t>(options_.size);
    const std::vector<Image> original = whole.slices;
    for (std::size_t k = 0; k < original.size(); ++k) {
      const std::size_t opposite = (k + original.size() / 2) % original.size();
      for (std::size_t i = 0; i < texels; ++i) {
        if (whole.seen[k * texels + i] == 1 || whole.seen[opposite * texels + i] != 1) continue;
        const int x = static_cast<int>(i) % options_.size;
        const int y = static_cast<int>(i) / options_.size;
        whole.slices[k].set_rgb(x, y, original[opposite].rgb(x, y));
      }
    }
  }

  void make_table() {
    AssembledSlices whole = assemble(stack_, result_.mask, first_angle_, kSymmetrySlices, 1);
    take_unseen_from_opposite(whole);
    std::vector<AmcFrame> frames;
    for (int i = 0; i < kSymmetrySlices; ++i) {
      frames.push_back({whole.slices[static_cast<std::size_t>(i)], static_cast<double>(i) / kSymmetrySlices});
    }
    result_.symmetry = analyse_symmetry(frames, options_.symmetry_threshold);
    const int symmetry = options_.symmetry.value_or(result_.symmetry.symmetry);
    AssembledSlices slices = assemble(stack_, result_.mask, first_angle_, options_.slices, symmetry);
    result_.table = AmcTable(options_.size, options_.slices, symmetry);
    result_.table.encoding = options_.encoding;
    result_.table.isotropic = !options_.symmetry && result_.symmetry.isotropic;
    for (int i = 0; i < options_.slices; ++i) {
      set_slice_image(result_.table, i, slices.slices[static_cast<std::size_t>(i)]);
    }
    quantise(result_.table);
    result_.seen_share = slices.seen_share;
    result_.seen = std::move(slices.seen);
    result_.table.provenance = {
        {"source", "capture"},
        {"frames", fmt::format("{} of {}", stack_.frames.size(), result_.frames.size())},
        {"first_angle_degrees", fmt::format("{:.3f}", degrees(wrap(first_angle_, 2 * kPi)))},
        {"focal_pixels", fmt::format("{:.2f} ({})", result_.camera.focal.x(), result_.camera.focal_source)},
        {"table_frame", options_.frame == TableFrame::eye ? "eye" : "view"},
    };
    report(options_.progress, 1);
  }

  /// The ball stands where the sphere stood, perhaps a little larger or smaller.
  void read_mirror_ball() {
    FrameSource source = FrameSource::open({options_.mirror_ball}, options_.source);
    if (source.width() != source_.width() || source.height() != source_.height()) {
      throw Error(fmt::format("{}: is {} x {}, the frames are {} x {}", options_.mirror_ball.string(),
                              source.width(), source.height(), source_.width(), source_.height()));
    }
    const Frame frame = source.read(0);
    const GreyPicture grey = grey_picture(frame, look_.factor);
    Vec2 centre = look_.centre;
    double radius = look_.outline.radius;
    double support = 0;
    for (const double reach : {0.15 * radius, 6.0, 3.0}) {
      const OutlineOffset offset = measure_outline(grey, 1, look_.outline.plate, look_.camera,
                                                   sphere_at(look_.camera, centre, radius), reach, false);
      centre += offset.shift;
      radius += offset.growth;
      support = offset.support;
    }
    if (support < 0.4) {
      throw Error(fmt::format("{}: no ball is found where the sphere stood; put it on the same stand",
                              options_.mirror_ball.string()));
    }
    const SphereView ball = sphere_at(result_.camera, centre * look_.factor, radius * look_.factor);
    result_.environment =
        mirror_ball_environment(frame, result_.camera, ball, kEnvironmentWidth, options_.mirror_reflectance);
  }

  /// What a wrong guess of the lens costs grows with how much of the view the sphere fills.
  void warn_of_lens() {
    const double half = result_.sphere.half_angle();
    const double bend = std::abs(std::sin(std::atan(0.5 * std::tan(half))) / std::sin(half) - 0.5);
    result_.warnings.push_back(
        fmt::format("the lens is unknown, so a horizontal field of view of {:.0f} degrees was assumed. If it "
                    "is much longer, normals are "
                    "off by about {:.1f} and tangents by about {:.1f} degrees half-way to the rim. Give "
                    "--focal-mm with --sensor-mm, "
                    "--fov, or a calibration (sateen capture calibrate)",
                    kAssumedFov, degrees(bend), degrees(half / 2)));
  }

  void warn_of_framing() {
    const double radius = look_.outline.radius * look_.factor;
    const double fills = 200 * radius / source_.height();
    if (fills < 35 || 2 * radius < 1.2 * options_.size) {
      result_.warnings.push_back(
          fmt::format("the sphere fills {:.0f} % of the picture's height ({:.0f} pixels for {} texels): move "
                      "closer or use a longer lens",
                      fills, 2 * radius, options_.size));
    }
    if (result_.camera.focal_source == "assumed") warn_of_lens();
    const double towards =
        degrees(std::acos(std::clamp(-result_.axis.dot(result_.sphere.centre.normalized()), -1.0, 1.0)));
    if (towards > 5) {
      result_.warnings.push_back(
          fmt::format("the turning axis points {:.1f} degrees past the camera: parts of the material are "
                      "seen only in part of the turn. "
                      "Point the axis at the lens",
                      towards));
    }
  }

  const CaptureOptions& options_;
  FrameSource source_;
  CaptureResult result_;
  FirstLook look_;
  Mat3 axes_ = Mat3::Identity();
  std::vector<FrameNotes> notes_;
  RectifiedStack stack_;
  double first_angle_ = 0;
};

}  // namespace

CaptureResult build_capture(const std::vector<std::filesystem::path>& inputs, const CaptureOptions& options) {
  return Builder(inputs, options).run();
}

}  // namespace sateen
