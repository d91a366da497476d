// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iterator>
#include <thread>

#include "microswarm/core/errors/write_error.hpp"
#include "microswarm/core/text/durable_rename.hpp"

namespace {

std::atomic<int> flushed_folders = 0;

}  // namespace

/// In place of the C library's, to count.
extern "C" int fsync(int file) {
  struct stat status {};
  if (::fstat(file, &status) == 0 && S_ISDIR(status.st_mode)) ++flushed_folders;
  return static_cast<int>(::syscall(SYS_fsync, file));
}

namespace microswarm {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
 protected:
  FileTest()
      : folder_(fs::path(testing::TempDir()) /
                ("microswarm_file_" + std::to_string(::getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~FileTest() override { fs::remove_all(folder_); }

  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_;
};

template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(FileTest, ReadsWhatWasWritten) {
  std::string bytes(100'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i >> 3);
  for (const std::string& content : {std::string(), std::string("a\n"), bytes}) {
    write_file_atomically(folder_ / "a.bin", content);
    EXPECT_EQ(read_file(folder_ / "a.bin"), content);
    EXPECT_EQ(files(), 1);
  }
}

TEST_F(FileTest, ReadingNamesTheFileAndTheReason) {
  const std::string missing = (folder_ / "no.yaml").string();
  EXPECT_EQ(message_of([&] { read_file(missing); }),
            missing + ": cannot read: No such file or directory");
  EXPECT_EQ(message_of([&] { read_file(folder_); }),
            folder_.string() + ": cannot read: Is a directory");
}

TEST_F(FileTest, ReadingHoldsTheLimit) {
  const fs::path path = folder_ / "a";
  write_file_atomically(path, "12345");
  EXPECT_EQ(read_file(path, 5), "12345");
  EXPECT_EQ(message_of([&] { read_file(path, 4); }),
            path.string() + ": cannot read: larger than the allowed 4 bytes");
  EXPECT_EQ(message_of([&] { read_file("/dev/zero", 1000); }),
            "/dev/zero: cannot read: larger than the allowed 1000 bytes");
}

TEST_F(FileTest, WritingNamesTheFileAndTheReason) {
  EXPECT_EQ(message_of([] { write_file_atomically("/dev/full", "x"); }),
            "/dev/full: cannot write: No space left on device");
  const fs::path nowhere = folder_ / "no" / "a.csv";
  EXPECT_EQ(message_of([&] { write_file_atomically(nowhere, "x"); }),
            nowhere.string() + ": cannot write: No such file or directory");
  EXPECT_EQ(message_of([&] { write_file_atomically(folder_, "x"); }),
            folder_.string() + ": cannot write: Is a directory");
  EXPECT_EQ(files(), 0);
}

TEST_F(FileTest, AnUncommittedFileLeavesTheOldOne) {
  const fs::path path = folder_ / "picture.png";
  write_file_atomically(path, "old");
  {
    StagedFile staged(path);
    EXPECT_EQ(staged.path().extension(), ".png");
    EXPECT_EQ(staged.path().parent_path(), folder_);
    std::ofstream(staged.path()) << "half";
    EXPECT_EQ(read_file(path), "old");
  }
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(FileTest, TwoWritersDoNotShareTheirStage) {
  const fs::path path = folder_ / "a.csv";
  StagedFile first(path), second(path);
  EXPECT_NE(first.path(), second.path());
  std::ofstream(first.path()) << "first";
  std::ofstream(second.path()) << "second";
  second.commit();
  first.commit();
  EXPECT_EQ(read_file(path), "first");
  EXPECT_EQ(files(), 1);
}

TEST_F(FileTest, WhatKilledProgramsLeftIsCleared) {
  const pid_t child = fork();
  if (child == 0) {
    const StagedFile left(folder_ / "table.csv");
    _exit(0);  // as if it was killed
  }
  waitpid(child, nullptr, 0);
  const StagedFile ours(folder_ / "table.csv");
  const std::vector<std::string> not_ours{"notes.tmp-1999-12.txt", "a.tmp-microswarm-1-2 of mine",
                                          "b.tmp-microswarm-x.csv"};
  for (const std::string& name : not_ours) write_file_atomically(folder_ / name, "not ours");
  ASSERT_EQ(files(), 5);
  clear_staged(folder_);
  EXPECT_EQ(files(), 4);
  EXPECT_TRUE(fs::exists(ours.path()));
  for (const std::string& name : not_ours) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  clear_staged(folder_ / "nowhere");
}

TEST(WriteFileAtomically, APipeWithoutAReaderIsRefusedAtOnce) {
  const std::string path = testing::TempDir() + "microswarm_read_pipe";
  ::unlink(path.c_str());
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_THROW(write_file_atomically(path, "text"), InputError);
  std::string got;
  std::jthread reader([&] {
    std::ifstream in(path);
    got.assign(std::istreambuf_iterator<char>(in), {});
  });
  const std::string bytes(200'000, 'x');  // more than a pipe holds
  for (bool is_read = false; !is_read;) try {
      write_file_atomically(path, bytes);
      is_read = true;
    } catch (const InputError&) {  // the reader is on its way
    }
  reader.join();
  EXPECT_EQ(got, bytes);
  ::unlink(path.c_str());
}

// Otherwise a power cut could undo the renaming.
TEST_F(FileTest, TheFolderIsFlushedAfterAFileGotItsName) {
  const int before = flushed_folders;
  write_file_atomically(folder_ / "state.yaml", "one");
  EXPECT_EQ(flushed_folders, before + 1);
  EXPECT_TRUE(rename_durably(folder_ / "state.yaml", folder_ / "other.yaml"));
  EXPECT_EQ(flushed_folders, before + 2);
  EXPECT_EQ(read_file(folder_ / "other.yaml"), "one");
  EXPECT_FALSE(rename_durably(folder_ / "state.yaml", folder_ / "other.yaml"));
}

TEST_F(FileTest, WhatCannotBeWrittenIsDistinguished) {
  EXPECT_THROW(write_file_atomically(folder_ / "none/state.yaml", "one"), WriteError);
  try {
    read_file(folder_ / "none");
    FAIL();
  } catch (const WriteError&) {
    FAIL() << "it was read";
  } catch (const InputError&) {
  }
}

TEST(ReadFile, APipeIsRefusedAtOnce) {
  const std::string path = testing::TempDir() + "microswarm_pipe";
  ::unlink(path.c_str());
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_THROW(read_file(path), InputError);
  ::unlink(path.c_str());
}

}  // namespace
}  // namespace microswarm
