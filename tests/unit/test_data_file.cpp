/// A file of numbers and texts: what is read is what was written, bit for bit; what is cut short, damaged or
/// of another kind is not taken; a file that is there survives a failure.
#include "support/data_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include <unistd.h>

namespace tribogel
{

namespace
{

class data_file : public ::testing::Test
{
protected:
  data_file()
      : directory(std::filesystem::temp_directory_path() / ("tribogel-data-" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(directory);
    path = directory / "some.h5";
  }
  ~data_file() override { std::filesystem::remove_all(directory); }

  std::string bytes() const
  {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void overwrite(const std::string &text) const { std::ofstream(path, std::ios::binary) << text; }

  std::string read() const
  {
    DataFile data;
    return read_data_file(path, "kind A", data);
  }

  const DataFile sample{{{"numbers", {0.1, -1e-310, std::numeric_limits<double>::infinity()}}, {"none", {}}},
                        {{"words", "two\nlines"}, {"empty", ""}}};
  std::filesystem::path directory, path;
};

} // namespace

TEST_F(data_file, GivesBackWhatWasWritten)
{
  ASSERT_EQ(write_data_file(path, "kind A", sample), "");
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));
  DataFile data;
  ASSERT_EQ(read_data_file(path, "kind A", data), "");
  EXPECT_EQ(data.numbers, sample.numbers);
  EXPECT_EQ(data.texts, sample.texts);
}

TEST_F(data_file, RefusesOtherKindsTextsAndNothing)
{
  EXPECT_NE(read().find("does not exist"), std::string::npos);
  ASSERT_EQ(write_data_file(path, "kind B", sample), "");
  EXPECT_NE(read().find("is no kind A"), std::string::npos);
  overwrite("no HDF5 at all\n");
  EXPECT_NE(read().find("no whole HDF5 file"), std::string::npos);
}

TEST_F(data_file, RefusesWhatIsCutShortAnywhere)
{
  ASSERT_EQ(write_data_file(path, "kind A", sample), "");
  const std::string whole = bytes();
  for (std::size_t length = 0; length < whole.size(); length += 37) {
    overwrite(whole.substr(0, length));
    EXPECT_NE(read(), "") << length << " of " << whole.size() << " bytes";
  }
  overwrite(whole);
  EXPECT_EQ(read(), "");
}

TEST_F(data_file, SeesAFlippedBitInTheNumbers)
{
  ASSERT_EQ(write_data_file(path, "kind A", sample), "");
  std::string damaged = bytes();
  const double number = 0.1;
  const std::size_t at = damaged.find(std::string(reinterpret_cast<const char *>(&number), sizeof number));
  ASSERT_NE(at, std::string::npos);
  damaged[at + 3] = static_cast<char>(damaged[at + 3] ^ 4);
  overwrite(damaged);
  EXPECT_NE(read().find("damaged"), std::string::npos);
}

TEST_F(data_file, LeavesTheOldFileWhenTheNewOneCannotBeWritten)
{
  ASSERT_EQ(write_data_file(path, "kind A", sample), "");
  std::filesystem::create_directory(path.string() + ".part"); // in the way
  EXPECT_NE(write_data_file(path, "kind A", {}), "");
  EXPECT_EQ(read(), "");
}

} // namespace tribogel
