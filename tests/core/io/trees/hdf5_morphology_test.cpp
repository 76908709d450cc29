#include "tests/support/peak_memory.h"
#include "tests/support/tree_bytes.h"

#include <doctest/doctest.h>
#include <hdf5.h>
#include <random>

using namespace ramus;

namespace {

// Writes a file in memory, one table after the other.
class Hdf5File {
public:
    Hdf5File() {
        const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
        H5Pset_fapl_core(access, 1 << 16, 0);
        file_ = H5Fcreate("made-by-a-test", H5F_ACC_TRUNC, H5P_DEFAULT, access);
        H5Pclose(access);
        REQUIRE(file_ >= 0);
    }
    Hdf5File(const Hdf5File&) = delete;
    Hdf5File& operator=(const Hdf5File&) = delete;
    ~Hdf5File() { H5Fclose(file_); }

    // `declared`: rows, where they shall differ from those that are written.
    Hdf5File& table(const char* name, hid_t type, hsize_t columns, const std::vector<double>& values,
                    bool compressed = false, hsize_t declared = 0) {
        const hsize_t sizes[2] = {declared > 0 ? declared : values.size() / columns, columns}, chunk[2] = {2, columns};
        const hid_t space = H5Screate_simple(2, sizes, nullptr), properties = H5Pcreate(H5P_DATASET_CREATE);
        if (compressed || declared > 0) H5Pset_chunk(properties, 2, chunk);
        if (compressed) H5Pset_shuffle(properties), H5Pset_deflate(properties, 9);
        const hid_t dataset = H5Dcreate2(file_, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
        REQUIRE(dataset >= 0);
        if (declared == 0)
            REQUIRE(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
        H5Dclose(dataset), H5Pclose(properties), H5Sclose(space);
        return *this;
    }

    std::string bytes() {
        H5Fflush(file_, H5F_SCOPE_GLOBAL);
        std::string image(static_cast<std::size_t>(H5Fget_file_image(file_, nullptr, 0)), '\0');
        REQUIRE(H5Fget_file_image(file_, image.data(), image.size()) >= 0);
        return image;
    }

private:
    hid_t file_;
};

const std::vector<double> kMorphologyPoints = {
    0, 0, 0,  4, 0, 0, 5,  3,   0, 0, 10, 2,  // section 0
    0, 0, 10, 2, 3, 0, 15, 1,                 // section 1
    0, 1, 10, 2, 0, 4, 15, 1.5, 0, 5, 20, 1}; // section 2, which begins apart
const std::vector<double> kSections = {0, 2, 3, 3, 5, 3}, kConnections = {0, 1, 0, 2};

std::string morphology(bool compressed = false) {
    return Hdf5File()
        .table("points", H5T_IEEE_F32BE, 4, kMorphologyPoints, compressed)
        .table("structure", H5T_STD_I32LE, 2, kSections, compressed)
        .table("connectivity", H5T_STD_U16BE, 2, kConnections)
        .bytes();
}

void check_morphology(const Result<tree::VesselTree>& tree) {
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    REQUIRE(tree->points.size() == 7);
    CHECK(tree->segment_count() == 6);
    CHECK(tree->branches.size() == 3);
    CHECK(tree->points[0].radius == 2.0);
    CHECK(tree->labels[0] == 2);
    CHECK(tree->labels[6] == 3);
    CHECK(tree->loop_count == 0);
}

} // namespace

TEST_CASE("HDF5 morphologies read, contiguous or compressed, with diameters halved") {
    check_morphology(io::parse_tree(morphology(), "m.h5"));
    check_morphology(io::parse_tree(morphology(true), "m.h5"));
    check_morphology(io::parse_tree(morphology(), "wrong.swc"));
    // The parent as a third column.
    check_morphology(io::parse_tree(Hdf5File()
                                        .table("points", H5T_IEEE_F64LE, 4, kMorphologyPoints)
                                        .table("structure", H5T_STD_I64LE, 3, {0, 2, -1, 3, 3, 0, 5, 3, 0})
                                        .bytes(),
                                    "m.h5"));
}

TEST_CASE("what is wrong with an HDF5 morphology is told") {
    const auto with = [](const std::vector<double>& sections, const std::vector<double>& connections) {
        return Hdf5File()
            .table("points", H5T_IEEE_F64LE, 4, kMorphologyPoints)
            .table("structure", H5T_STD_I64LE, 2, sections)
            .table("connectivity", H5T_STD_I64LE, 2, connections)
            .bytes();
    };
    CHECK(test::refusal(Hdf5File().bytes(), "m.h5").find("/points") != std::string::npos);
    CHECK(test::refusal(Hdf5File().table("points", H5T_IEEE_F64LE, 4, kMorphologyPoints).bytes(), "m.h5")
              .find("/structure") != std::string::npos);
    CHECK(test::refusal(with({0, 2, 3, 3, 99, 3}, kConnections), "m.h5").find("8 points") != std::string::npos);
    CHECK(test::refusal(with({0, 2, 5, 3, 3, 3}, kConnections), "m.h5").find("row 1 of /structure") !=
          std::string::npos);
    CHECK(test::refusal(with(kSections, {0, 1, 0, 3}), "m.h5").find("only 3 sections") != std::string::npos);
    CHECK(test::refusal(with(kSections, {0, 1, -1, 2}), "m.h5").find("row 1 of /connectivity") != std::string::npos);
    const test::PeakMemory memory;
    const std::string lie = Hdf5File()
                                .table("points", H5T_IEEE_F64LE, 4, {}, true, 1'000'000'000)
                                .table("structure", H5T_STD_I64LE, 2, kSections)
                                .bytes();
    CHECK(test::refusal(lie, "m.h5").find("1000000000 x 4") != std::string::npos);
    CHECK(memory.grown_mib() < 30.0);
}

TEST_CASE("damaged HDF5 files cannot crash this program") {
    const std::string whole = morphology(true);
    std::mt19937 random(7);
    for (int n = 0; n < 60; ++n) {
        std::string damaged = whole;
        for (int changes = 0; changes < 20; ++changes)
            damaged[16 + random() % (damaged.size() - 16)] = static_cast<char>(random() % 256);
        const auto tree = io::parse_tree(damaged, "m.h5");
        if (!tree) CHECK(tree.error().where.starts_with("m.h5"));
    }
}
