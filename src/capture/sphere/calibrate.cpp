// SPDX-License-Identifier: MIT
#include "sateen/capture/sphere/calibrate.h"

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "sateen/core/error.h"
#include "sateen/io/picture8.h"

namespace sateen::capture {

Calibration calibrate(const std::vector<std::filesystem::path>& pictures, int columns, int rows) {
  Calibration result;
  const cv::Size board(columns, rows);
  std::vector<cv::Point3f> flat;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) flat.emplace_back(static_cast<float>(c), static_cast<float>(r), 0.0f);
  }
  std::vector<std::vector<cv::Point2f>> seen;
  cv::Size size;
  for (const auto& path : pictures) {
    io::Picture8 picture = io::read_picture8(path);
    if (size.empty()) size = {picture.width, picture.height};
    if (size != cv::Size(picture.width, picture.height)) {
      throw Error(fmt::format("{}: is {} x {}, the first picture is {} x {}", path.string(), picture.width,
                              picture.height, size.width, size.height));
    }
    cv::Mat grey;
    cv::cvtColor(cv::Mat(picture.height, picture.width, CV_8UC3, picture.rgb.data()), grey,
                 cv::COLOR_RGB2GRAY);
    std::vector<cv::Point2f> corners;
    if (!cv::findChessboardCorners(grey, board, corners,
                                   cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE)) {
      result.unusable.push_back(path.filename().string());
      continue;
    }
    cv::cornerSubPix(grey, corners, {5, 5}, {-1, -1},
                     cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 40, 0.001));
    seen.push_back(corners);
  }
  if (seen.size() < 5) {
    throw Error(fmt::format(
        "a chessboard with {} x {} inner corners is found in {} of {} pictures; at least 5 are needed, in "
        "different poses, with the whole board visible",
        columns, rows, seen.size(), pictures.size()));
  }
  const std::vector<std::vector<cv::Point3f>> boards(seen.size(), flat);
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat distortion;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  result.rms_pixels = cv::calibrateCamera(boards, seen, size, matrix, distortion, rotations, translations);
  if (!(result.rms_pixels < 2)) {
    throw Error(fmt::format(
        "the calibration does not fit: corners are off by {:.1f} pixels. Is the board flat, and is it "
        "{} x {} inner corners?",
        result.rms_pixels, columns, rows));
  }
  result.used = static_cast<int>(seen.size());
  Camera& camera = result.camera;
  camera.width = size.width;
  camera.height = size.height;
  camera.focal = {matrix.at<double>(0, 0), matrix.at<double>(1, 1)};
  // OpenCV counts from the middle of the first pixel, we from its corner.
  camera.principal = {matrix.at<double>(0, 2) + 0.5, matrix.at<double>(1, 2) + 0.5};
  for (int i = 0; i < 5; ++i) camera.distortion[static_cast<std::size_t>(i)] = distortion.at<double>(i);
  return result;
}

}  // namespace sateen::capture
