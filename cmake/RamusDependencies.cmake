# Everything that is not our field comes from Debian's packages; scripts/setup installs them.
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tl-expected REQUIRED)
find_package(CLI11 REQUIRED)
find_package(PNG REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
# SIMD code is compiled for AVX-512, AVX2, SSE4 and plain C++; processors that have SSSE3 and no SSE4 are of 2006.
target_compile_definitions(PkgConfig::HWY INTERFACE HWY_DISABLED_TARGETS=HWY_SSSE3)
pkg_check_modules(ASSIMP REQUIRED IMPORTED_TARGET assimp) # its CMake files ask for packages that it does not need

# NIfTI volumes; Debian's package brings no CMake files.
find_path(RAMUS_NIFTI_INCLUDE nifti/nifti2_io.h REQUIRED)
find_library(RAMUS_NIFTI_LIBRARY nifti2 REQUIRED)
find_library(RAMUS_ZNZ_LIBRARY znz REQUIRED)
add_library(ramus_nifti INTERFACE)
target_include_directories(ramus_nifti SYSTEM INTERFACE ${RAMUS_NIFTI_INCLUDE} ${RAMUS_NIFTI_INCLUDE}/nifti)
target_link_libraries(ramus_nifti INTERFACE ${RAMUS_NIFTI_LIBRARY} ${RAMUS_ZNZ_LIBRARY})
