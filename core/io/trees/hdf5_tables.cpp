#include "core/io/trees/hdf5_tables.h"

#include "core/base/own_process.h"
#include "core/io/inflate.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <hdf5.h>
#include <utility>

namespace ramus::io {

namespace {

constexpr const char* kGetHdf5Again = "the file is incomplete or damaged; get it again";

class Hdf5Handle {
public:
    Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    Hdf5Handle(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(const Hdf5Handle&) = delete;
    ~Hdf5Handle() {
        if (id_ >= 0) close_(id_);
    }
    [[nodiscard]] bool good() const { return id_ >= 0; }
    [[nodiscard]] hid_t id() const { return id_; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

// Whether the values are in the file itself, and use only filters whose expansion is limited. `plain`: set to whether
// none of the filters compresses.
bool is_stored_plainly(hid_t dataset, bool& plain) {
    const Hdf5Handle properties(H5Dget_create_plist(dataset), H5Pclose);
    if (!properties.good() || H5Pget_external_count(properties.id()) != 0) return false;
    const H5D_layout_t layout = H5Pget_layout(properties.id());
    if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED && layout != H5D_COMPACT) return false;
    const int filters = H5Pget_nfilters(properties.id());
    plain = true;
    for (int f = 0; f < filters; ++f) {
        unsigned flags = 0, config = 0;
        std::size_t values = 0;
        const H5Z_filter_t filter =
            H5Pget_filter2(properties.id(), static_cast<unsigned>(f), &flags, &values, nullptr, 0, nullptr, &config);
        if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_FLETCHER32)
            return false;
        plain = plain && filter != H5Z_FILTER_DEFLATE;
    }
    return filters >= 0;
}

// `file_size` in bytes.
Result<Hdf5Table> read_hdf5_table(hid_t file, const std::string& name, std::uint64_t file_size) {
    const std::string what = "the dataset /" + name;
    H5L_info_t link{};
    if (H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0) return Hdf5Table{};
    if (H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
        return fail(what + " lies in another file", {}, "copy it into this one");
    const Hdf5Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.good()) return fail(what + " cannot be opened", {}, kGetHdf5Again);
    const Hdf5Handle space(H5Dget_space(dataset.id()), H5Sclose), type(H5Dget_type(dataset.id()), H5Tclose);
    std::array<hsize_t, 2> sizes{};
    if (!space.good() || !type.good() || H5Sget_simple_extent_type(space.id()) != H5S_SIMPLE ||
        H5Sget_simple_extent_ndims(space.id()) != 2 ||
        H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr) != 2)
        return fail(what + " is no table of rows and columns", {}, "write it as one");
    const H5T_class_t kind = H5Tget_class(type.id());
    const std::uint64_t size = H5Tget_size(type.id());
    if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || size == 0 || size > 8)
        return fail(what + " does not hold plain numbers", {}, "write it as integers or floats");
    bool plain = true;
    if (!is_stored_plainly(dataset.id(), plain))
        return fail(what + " is stored in a way that is not read", {}, "write it plainly or with gzip");
    const std::uint64_t rows = sizes[0], columns = sizes[1], most = inflation_limit(file_size) / sizeof(double);
    const std::uint64_t stored = H5Dget_storage_size(dataset.id());
    if (columns == 0 || columns > 64 || rows > most / columns || stored > file_size ||
        rows * columns * size / (plain ? 1 : kMostInflation) > stored)
        return fail(what + " declares " + std::to_string(rows) + " x " + std::to_string(columns) +
                        " numbers, more than the file can hold",
                    {}, kGetHdf5Again);
    Hdf5Table table{true, rows, columns, std::vector<double>(rows * columns)};
    if (rows > 0 && H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, table.values.data()) < 0)
        return fail(what + " cannot be read", {}, kGetHdf5Again);
    return table;
}

Result<std::vector<Hdf5Table>> read_all_tables(std::string_view bytes, const std::vector<std::string>& names) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    H5PLset_loading_state(0); // loads no plugins
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    // The library copies the bytes; it does not write to them.
    if (H5Pset_fapl_core(access.id(), std::size_t{1} << 16, 0) < 0 ||
        H5Pset_file_image(access.id(), const_cast<char*>(bytes.data()), bytes.size()) < 0)
        return fail("the file cannot be opened", {}, "free some memory");
    const Hdf5Handle file(H5Fopen("file.h5", H5F_ACC_RDONLY, access.id()), H5Fclose);
    if (!file.good()) return fail("this is no HDF5 file that can be read", {}, kGetHdf5Again);
    std::vector<Hdf5Table> tables;
    for (const std::string& name : names) {
        RAMUS_TRY(table, read_hdf5_table(file.id(), name, bytes.size()));
        tables.push_back(std::move(table));
    }
    return tables;
}

// The answer of the process: a letter, then a message of two lines, or for each table its number of rows, of columns
// and its values, binary.
constexpr char kHdf5Error = 'E', kHdf5Tables = 'T';

void append_bytes(std::string& bytes, const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
}

// `input`: the names of the tables, one a line, an empty line, and the bytes of the file.
std::string answer_with_tables(std::string_view input) {
    std::vector<std::string> names;
    while (true) {
        const std::size_t line = input.find('\n');
        const std::string name(input.substr(0, line));
        input.remove_prefix(line + 1);
        if (name.empty()) break;
        names.push_back(name);
    }
    const auto tables = read_all_tables(input, names);
    if (!tables) return kHdf5Error + tables.error().what + "\n" + tables.error().hint;
    std::string bytes(1, kHdf5Tables);
    for (const Hdf5Table& table : *tables) {
        const std::array<std::uint64_t, 3> sizes = {table.present ? 1U : 0U, table.rows, table.columns};
        append_bytes(bytes, sizes.data(), sizeof(sizes));
        append_bytes(bytes, table.values.data(), table.values.size() * sizeof(double));
    }
    return bytes;
}

Result<std::vector<Hdf5Table>> from_answer(std::string_view answer, std::size_t count, const std::string& where) {
    const auto damaged = [&] { return fail("this HDF5 file is damaged", where, "get it again"); };
    if (answer.empty()) return damaged();
    const char letter = answer.front();
    answer.remove_prefix(1);
    if (letter == kHdf5Error) {
        const std::size_t line = answer.find('\n');
        return fail(std::string(answer.substr(0, line)), where, std::string(answer.substr(line + 1)));
    }
    std::vector<Hdf5Table> tables(count);
    for (Hdf5Table& table : tables) {
        std::array<std::uint64_t, 3> sizes{};
        if (answer.size() < sizeof(sizes)) return damaged();
        std::memcpy(sizes.data(), answer.data(), sizeof(sizes));
        answer.remove_prefix(sizeof(sizes));
        const std::uint64_t numbers = answer.size() / sizeof(double);
        if (sizes[2] > 64 || sizes[1] > numbers || sizes[1] * sizes[2] > numbers) return damaged();
        table = {sizes[0] == 1, sizes[1], sizes[2], std::vector<double>(sizes[1] * sizes[2])};
        if (!table.values.empty())
            std::memcpy(table.values.data(), answer.data(), table.values.size() * sizeof(double));
        answer.remove_prefix(table.values.size() * sizeof(double));
    }
    return tables;
}

} // namespace

Result<std::vector<Hdf5Table>> read_hdf5_tables(std::string_view file, const std::vector<std::string>& names,
                                                const std::string& where) {
    ProcessLimits limits;
    constexpr std::uint64_t kLibrary = std::uint64_t{192} << 20; // for itself
    limits.memory = 4 * file.size() + std::max(3 * inflation_limit(file.size()), kLibrary);
    limits.answer = inflation_limit(file.size()) * names.size();
    std::string input;
    for (const std::string& name : names) input += name + "\n";
    input += '\n';
    input += file;
    const auto answer = run_in_own_process(answer_with_tables, input, limits);
    return from_answer(answer ? std::string_view(*answer) : std::string_view(), names.size(), where);
}

} // namespace ramus::io
