#include "support/data_file.hpp"

#include <hdf5.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace tribogel
{

namespace
{

constexpr const char *kind_name = "kind";

/// An HDF5 identifier that closes itself.
class Id
{
public:
  Id(hid_t opened, herr_t (*closing)(hid_t)) : id(opened), close(closing) {}
  Id(const Id &) = delete;
  Id &operator=(const Id &) = delete;
  ~Id() { release(); }
  operator hid_t() const { return id; }
  bool open() const { return id >= 0; }
  bool release() ///< false if closing failed, which may be when the data are written
  {
    const bool closed = id < 0 || close(id) >= 0;
    id = -1;
    return closed;
  }

private:
  hid_t id;
  herr_t (*close)(hid_t);
};

void silence_hdf5()
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

bool write_array(hid_t file, const std::string &name, hid_t stored, hid_t given, const void *values, hsize_t size)
{
  const Id space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (size > 0 && (H5Pset_chunk(properties, 1, &size) < 0 || H5Pset_fletcher32(properties) < 0)) return false;
  const Id set(H5Dcreate2(file, name.c_str(), stored, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  return set.open() && (size == 0 || H5Dwrite(set, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
}

bool write_all(hid_t file, const std::string &kind, const DataFile &data)
{
  const auto write_text = [file](const std::string &name, const std::string &text) {
    return write_array(file, name, H5T_STD_U8LE, H5T_NATIVE_UCHAR, text.data(), text.size());
  };
  bool good = write_text(kind_name, kind);
  for (const auto &[name, text] : data.texts) good = good && write_text(name, text);
  for (const auto &[name, values] : data.numbers)
    good = good && write_array(file, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data(), values.size());
  return good;
}

/// A one-dimensional array into `numbers` or, if it holds bytes, into `text`.
bool read_array(hid_t set, std::vector<double> *numbers, std::string *text)
{
  const Id space(H5Dget_space(set), H5Sclose);
  hsize_t size = 0;
  if (H5Sget_simple_extent_ndims(space) != 1 || H5Sget_simple_extent_dims(space, &size, nullptr) < 0) return false;
  if (numbers) numbers->resize(size);
  if (text) text->resize(size);
  if (size == 0) return true;
  return H5Dread(set, numbers ? H5T_NATIVE_DOUBLE : H5T_NATIVE_UCHAR, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                 numbers ? static_cast<void *>(numbers->data()) : text->data()) >= 0;
}

bool is_text(hid_t set)
{
  const Id type(H5Dget_type(set), H5Tclose);
  return H5Tget_class(type) == H5T_INTEGER && H5Tget_size(type) == 1;
}

std::string kind_of(hid_t file)
{
  std::string kind;
  const Id set(H5Dopen2(file, kind_name, H5P_DEFAULT), H5Dclose);
  return set.open() && is_text(set) && read_array(set, nullptr, &kind) ? kind : std::string();
}

bool read_all(hid_t file, DataFile &data)
{
  H5G_info_t group;
  if (H5Gget_info(file, &group) < 0) return false;
  for (hsize_t k = 0; k < group.nlinks; ++k) {
    char name[256];
    if (H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT) < 0) return false;
    const Id set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    if (!set.open()) return false;
    const bool good =
        is_text(set) ? read_array(set, nullptr, &data.texts[name]) : read_array(set, &data.numbers[name], nullptr);
    if (!good) return false;
  }
  return true;
}

} // namespace

bool bring_to_disk(const std::string &path)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool good = fsync(file) == 0;
  close(file);
  return good;
}

std::string write_data_file(const std::string &path, const std::string &kind, const DataFile &data)
{
  const std::string part = path + ".part";
  silence_hdf5();
  Id file(H5Fcreate(part.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  if (!file.open()) return part + " cannot be written";
  const bool written = write_all(file, kind, data);
  if (!file.release() || !written || !bring_to_disk(part)) return part + " cannot be written in full";
  if (std::rename(part.c_str(), path.c_str()) != 0) return path + ": " + std::strerror(errno);
  bring_to_disk(std::filesystem::absolute(path).parent_path().string());
  return {};
}

std::string read_data_file(const std::string &path, const std::string &kind, DataFile &data)
{
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return path + " does not exist";
  silence_hdf5();
  const Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.open()) return path + " cannot be read or is no whole HDF5 file";
  if (kind_of(file) != kind) return path + " is no " + kind;
  if (!read_all(file, data)) return path + " is damaged";
  data.texts.erase(kind_name);
  return {};
}

} // namespace tribogel
