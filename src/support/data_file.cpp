#include "support/data_file.hpp"

#include "support/files.hpp"

#include <hdf5.h>

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
  ~Id()
  {
    if (open()) close(id);
  }
  operator hid_t() const { return id; }
  bool open() const { return id >= 0; }

private:
  hid_t id;
  herr_t (*close)(hid_t);
};

void silence_hdf5()
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

bool write_array(hid_t file, const std::string &name, hid_t stored, hid_t given, const void *values,
                 hsize_t size)
{
  const Id space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (size > 0 && (H5Pset_chunk(properties, 1, &size) < 0 || H5Pset_fletcher32(properties) < 0)) return false;
  const Id set(H5Dcreate2(file, name.c_str(), stored, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  return set.open() && (size == 0 || H5Dwrite(set, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
}

bool fill(hid_t file, const std::string &kind, const DataFile &data)
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

/// The file's bytes. HDF5 makes them in memory: one that cannot write to a device is left with an open file,
/// and takes the program down when that ends.
bool image_of(const std::string &kind, const DataFile &data, std::string &image)
{
  constexpr std::size_t growth = 1 << 20; // of the memory, at a time [bytes]
  const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (H5Pset_fapl_core(access, growth, false) < 0) return false;
  const Id file(H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  if (!file.open() || !fill(file, kind, data) || H5Fflush(file, H5F_SCOPE_GLOBAL) < 0) return false;
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size <= 0) return false;
  image.resize(static_cast<std::size_t>(size));
  return H5Fget_file_image(file, image.data(), image.size()) == size;
}

/// A one-dimensional array into `numbers` or, if it holds bytes, into `text`.
bool read_array(hid_t set, std::vector<double> *numbers, std::string *text)
{
  const Id space(H5Dget_space(set), H5Sclose);
  hsize_t size = 0;
  if (H5Sget_simple_extent_ndims(space) != 1 || H5Sget_simple_extent_dims(space, &size, nullptr) < 0)
    return false;
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
    if (H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT) < 0)
      return false;
    const Id set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    if (!set.open()) return false;
    const bool good = is_text(set) ? read_array(set, nullptr, &data.texts[name])
                                   : read_array(set, &data.numbers[name], nullptr);
    if (!good) return false;
  }
  return true;
}

} // namespace

std::string write_data_file(const std::string &path, const std::string &kind, const DataFile &data)
{
  silence_hdf5();
  std::string image;
  if (!image_of(kind, data, image)) return path + ": HDF5 cannot make its image in memory";
  return replace_file(path, image);
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
