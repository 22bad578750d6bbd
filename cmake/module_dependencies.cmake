# SPDX-License-Identifier: MIT
# What only the modules (src/io/modules) and the tests stand on; the library and the program do not link it.
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs videoio calib3d)
# OpenImageIO's own CMake config needs the tools package; pkg-config does not.
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO)
# Version 5.1 or later.
pkg_check_modules(FFMPEG REQUIRED IMPORTED_TARGET libavformat>=59.27 libavcodec>=59.37 libswscale>=6.7 libavutil>=57.28)
