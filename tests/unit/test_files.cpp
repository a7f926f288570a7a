/// Files that cannot grow, by a limit of the system that is lifted again: nothing is written in part, the
/// reason is the system's, and what was there stays.
#include "support/data_file.hpp"
#include "support/files.hpp"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace tribogel
{

namespace
{

/// While it lives, no file of this process grows beyond so many bytes; a write that tries fails and kills
/// nobody.
class SizeLimit
{
public:
  explicit SizeLimit(rlim_t bytes) : ignored(std::signal(SIGXFSZ, SIG_IGN))
  {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit now = {bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  SizeLimit(const SizeLimit &) = delete;
  SizeLimit &operator=(const SizeLimit &) = delete;
  ~SizeLimit()
  {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, ignored);
  }

private:
  rlimit before = {};
  void (*ignored)(int);
};

class files : public ::testing::Test
{
protected:
  files() : directory(std::filesystem::temp_directory_path() / ("tribogel-files-" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(directory);
    path = directory / "some.csv";
  }
  ~files() override { std::filesystem::remove_all(directory); }

  std::string text() const
  {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string too_large(const std::string &suffix = "") const
  {
    return path.string() + suffix + ": " + std::strerror(EFBIG);
  }

  std::filesystem::path directory, path;
};

} // namespace

TEST_F(files, GrowsByWholeRows)
{
  GrowingFile file;
  ASSERT_EQ(file.create(path), "");
  ASSERT_EQ(file.append("time,N\n"), "");
  ASSERT_EQ(file.append("0,1\n"), "");
  EXPECT_EQ(file.bring_to_disk(), "");
  EXPECT_EQ(file.size(), 11u);
  EXPECT_EQ(text(), "time,N\n0,1\n");
}

TEST_F(files, LeavesNothingOfARowThatCannotBeWritten)
{
  GrowingFile file;
  ASSERT_EQ(file.create(path), "");
  ASSERT_EQ(file.append("0,1\n"), "");
  {
    const SizeLimit for_a_moment(6);
    EXPECT_EQ(file.append("1,2\n"), too_large());
    EXPECT_EQ(text(), "0,1\n");
    EXPECT_EQ(file.size(), 4u);
  }
  EXPECT_EQ(file.append("2,3\n"), "");
  EXPECT_EQ(text(), "0,1\n2,3\n");
}

TEST_F(files, GoesOnBehindWhatCounts)
{
  std::ofstream(path) << "0,1\n1,2\n2,";
  GrowingFile file;
  ASSERT_EQ(file.resume(path, 8), "");
  EXPECT_EQ(text(), "0,1\n1,2\n");
  ASSERT_EQ(file.append("2,3\n"), "");
  EXPECT_EQ(text(), "0,1\n1,2\n2,3\n");
  EXPECT_NE(file.resume(path, 13), "") << "it has 12 bytes";
  EXPECT_EQ(text().size(), 12u);
  EXPECT_EQ(file.resume(directory / "none.csv", 0),
            (directory / "none.csv").string() + ": " + std::strerror(ENOENT));
}

TEST_F(files, NoticesWhatOthersDoToIt)
{
  GrowingFile file;
  ASSERT_EQ(file.create(path), "");
  ASSERT_EQ(file.append("0,1\n"), "");
  std::ofstream(path, std::ios::app) << "5,6\n";
  EXPECT_EQ(file.append("1,2\n"), path.string() + ": changed by another program");
  EXPECT_EQ(text(), "0,1\n5,6\n");
  std::filesystem::remove(path);
  EXPECT_EQ(file.append("1,2\n"), path.string() + ": " + std::strerror(ENOENT));
  std::filesystem::remove_all(directory);
  EXPECT_EQ(file.append("1,2\n"), path.string() + ": " + std::strerror(ENOENT));
  EXPECT_EQ(file.create(path), path.string() + ": " + std::strerror(ENOENT));
}

TEST_F(files, KeepsTheOldFileWhenTheNewOneDoesNotFit)
{
  ASSERT_EQ(replace_file(path, "old\n"), "");
  {
    const SizeLimit for_a_moment(6);
    EXPECT_EQ(replace_file(path, "new one\n"), too_large(".part"));
  }
  EXPECT_EQ(text(), "old\n");
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));
  EXPECT_EQ(replace_file(path, "new one\n"), "");
  EXPECT_EQ(text(), "new one\n");
}

TEST_F(files, SaysWhereADirectoryIsInTheWay)
{
  std::filesystem::create_directories(path / "in the way");
  EXPECT_EQ(replace_file(path, "new\n"), path.string() + ": " + std::strerror(EISDIR));
  EXPECT_EQ(replace_file(directory / "none" / "file", "new\n"),
            (directory / "none" / "file.part: ").string() + std::strerror(ENOENT));
}

/// HDF5 that fails to write a file takes the program down at its end: it must not be the one that writes.
TEST_F(files, KeepsTheOldNumbersAtAnyLimit)
{
  const DataFile old{{{"numbers", {1, 2}}}, {}},
      next{{{"numbers", std::vector<double>(1000, 3.5)}}, {{"text", "words"}}};
  ASSERT_EQ(write_data_file(path, "kind", old), "");
  ASSERT_EQ(write_data_file(directory / "next", "kind", next), "");
  const std::string before = text();
  const std::uintmax_t size = std::filesystem::file_size(directory / "next");
  for (std::uintmax_t bytes = 0; bytes < size; bytes += 512) {
    const SizeLimit limit(bytes);
    EXPECT_EQ(write_data_file(path, "kind", next), too_large(".part")) << bytes << " of " << size << " bytes";
    EXPECT_EQ(text(), before);
  }
  EXPECT_EQ(write_data_file(path, "kind", next), "");
  DataFile found;
  EXPECT_EQ(read_data_file(path, "kind", found), "");
  EXPECT_EQ(found.numbers, next.numbers);
}

} // namespace tribogel
