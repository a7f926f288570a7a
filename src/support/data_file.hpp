/// Numbers and texts by name in one HDF5 file, written so that a crash leaves either the old file or the new
/// one.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tribogel
{

struct DataFile {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> texts;
};

/// As replace_file does it; every array has a checksum. `kind` tells such files from others. Returns what
/// went wrong, empty if nothing did.
std::string write_data_file(const std::string &path, const std::string &kind, const DataFile &data);

/// The counterpart of writing; a file that is cut short, damaged or of another kind is not taken.
std::string read_data_file(const std::string &path, const std::string &kind, DataFile &data);

} // namespace tribogel
