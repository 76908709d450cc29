# Everything that is not our field comes from Debian's packages; scripts/setup installs them.
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tl-expected REQUIRED)
find_package(CLI11 REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(pugixml REQUIRED)
find_package(meshoptimizer CONFIG REQUIRED)
find_package(Boost REQUIRED) # headers alone: the distributions of Boost.Math
find_package(OpenSSL REQUIRED COMPONENTS Crypto) # libhdf5-dev brings it; checksums
find_package(PkgConfig REQUIRED)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
# SIMD code is compiled for AVX-512, AVX2, SSE4 and plain C++; processors that have SSSE3 and no SSE4 are of 2006.
target_compile_definitions(PkgConfig::HWY INTERFACE HWY_DISABLED_TARGETS=HWY_SSSE3)
pkg_check_modules(LZ4 REQUIRED IMPORTED_TARGET liblz4) # blocks of VTK's XML files
pkg_check_modules(LZMA REQUIRED IMPORTED_TARGET liblzma)
pkg_check_modules(TIFF REQUIRED IMPORTED_TARGET libtiff-4) # compressed pixels of TIFF
pkg_check_modules(BLOSC REQUIRED IMPORTED_TARGET blosc) # chunks of Zarr
pkg_check_modules(SECCOMP REQUIRED IMPORTED_TARGET libseccomp) # processes that read files
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial)
pkg_check_modules(ASSIMP REQUIRED IMPORTED_TARGET assimp) # its CMake files ask for packages that it does not need

# NIfTI volumes; Debian's package brings no CMake files.
find_path(RAMUS_NIFTI_INCLUDE nifti/nifti2_io.h REQUIRED)
find_library(RAMUS_NIFTI_LIBRARY nifti2 REQUIRED)
find_library(RAMUS_ZNZ_LIBRARY znz REQUIRED)
add_library(ramus_nifti INTERFACE)
target_include_directories(ramus_nifti SYSTEM INTERFACE ${RAMUS_NIFTI_INCLUDE} ${RAMUS_NIFTI_INCLUDE}/nifti)
target_link_libraries(ramus_nifti INTERFACE ${RAMUS_NIFTI_LIBRARY} ${RAMUS_ZNZ_LIBRARY})

# DICOM; the CMake files of Debian's package ask for VTK.
find_path(RAMUS_GDCM_INCLUDE gdcmReader.h PATH_SUFFIXES gdcm-3.0 REQUIRED)
add_library(ramus_gdcm INTERFACE)
target_include_directories(ramus_gdcm SYSTEM INTERFACE ${RAMUS_GDCM_INCLUDE})
foreach(part MSFF DSED DICT Common)
  find_library(RAMUS_GDCM_${part} gdcm${part} REQUIRED)
  target_link_libraries(ramus_gdcm INTERFACE ${RAMUS_GDCM_${part}})
endforeach()
