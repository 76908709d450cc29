# `scripts/package`: a Debian package of what `cmake --install` installs. What the program opens by name while it runs
# (OSMesa, OpenGL, the font) is named here; dpkg-shlibdeps finds the libraries that it is linked with.
set(RAMUS_MAINTAINER "The ramus developers <ramus@localhost>" CACHE STRING "Who makes the package: NAME <ADDRESS>")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT ${RAMUS_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "explore vessel trees as smooth, closed surfaces")
set(CPACK_PACKAGE_DESCRIPTION
"ramus turns the centerlines and radii of a vessel tree, or a segmentation mask,
into a smooth, closed surface, and shows what depends on each branch, what lies
near a lesion and what a cut would cost. It draws the same pictures without a
display, writes meshes, and holds surfaces against the trees that they are of.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libosmesa6 (>= 22), libgl1")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "fonts-open-sans, libegl1, libgl1-mesa-dri, weasyprint")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "snakemake, python3-matplotlib")
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/DebianFiles.cmake)
set(CPACK_RAMUS_CHANGELOG ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
include(CPack)
