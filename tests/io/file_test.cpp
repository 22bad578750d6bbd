// SPDX-License-Identifier: MIT
#include "sateen/io/file.h"

#include <csignal>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "full_disk.h"
#include "sateen/core/error.h"
#include "support/files.h"

namespace sateen::io {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(File, BytesComeBackWhateverTheirNumber) {
  const TemporaryFolder folder;
  for (const std::size_t size : {0u, 1u, 4096u, 65536u, 300001u}) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 7 % 251);
    write_bytes(folder / "ein Öhr 絹.bin", bytes);
    EXPECT_EQ(read_bytes(folder / "ein Öhr 絹.bin"), bytes);
  }
}

TEST(File, APipeIsReadToItsEnd) {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(200000, 'x');
  std::thread writer([&] { std::ofstream(pipe) << text; });
  EXPECT_EQ(read_text(pipe), text);
  writer.join();
}

TEST(File, WhatCannotBeReadIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal([&] { read_bytes(folder / "none"); }), HasSubstr("none: no such file"));
  EXPECT_THAT(refusal([&] { read_bytes(folder.path()); }), HasSubstr("is a folder"));
  EXPECT_THAT(refusal([&] { read_bytes("/dev/zero"); }), HasSubstr("/dev/zero: is a device"));
}

TEST(File, AFailedWriteLeavesTheOlderFileAndNothingElse) {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "old");
  const auto write = [](const fs::path& temporary) {
    std::ofstream(temporary) << "half";
    throw Error("it broke");
  };
  EXPECT_EQ(refusal([&] { write_atomically(folder / "a.txt", write); }), "it broke");
  EXPECT_EQ(refusal([&] { write_atomically(folder / "b.txt", write); }), "it broke");
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.txt"));
}

TEST(File, FilesThatBelongTogetherAppearTogetherOrNotAtAll) {
  const TemporaryFolder folder;
  const std::vector<fs::path> targets{folder / "a.txt", folder / "b.txt"};
  const auto write = [&](std::span<const fs::path> temporaries) {
    ASSERT_EQ(temporaries.size(), 2u);
    std::ofstream(temporaries[0]) << "a";
    EXPECT_FALSE(fs::exists(targets[1]));
    std::ofstream(temporaries[1]) << "b";
  };
  const auto fail = [&](std::span<const fs::path> temporaries) {
    write(temporaries);
    throw Error("it broke");
  };
  EXPECT_EQ(refusal([&] { write_atomically(targets, fail); }), "it broke");
  EXPECT_THAT(names_in(folder.path()), ElementsAre());
  write_atomically(targets, write);
  EXPECT_EQ(read_text(targets[0]) + read_text(targets[1]), "ab");
}

TEST(File, WhileWritingTheTargetIsStillTheOlderFile) {
  const TemporaryFolder folder;
  write_text(folder / "a.png", "old");
  write_atomically(folder / "a.png", [&](const fs::path& temporary) {
    EXPECT_EQ(temporary.parent_path(), folder.path());
    EXPECT_EQ(temporary.extension(), ".png");
    std::ofstream(temporary) << "new";
    EXPECT_EQ(read_text(folder / "a.png"), "old");
  });
  EXPECT_EQ(read_text(folder / "a.png"), "new");
}

TEST(File, TheLongestNameCanBeWritten) {
  const TemporaryFolder folder;
  const fs::path path = folder / (std::string(251, 'n') + ".txt");
  write_text(path, "x");
  EXPECT_EQ(read_text(path), "x");
}

TEST(File, PermissionsAreKeptAndReadOnlyFilesAreRefused) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.txt";
  write_text(path, "old");
  fs::permissions(path, fs::perms(0640));
  write_text(path, "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms(0640));
  fs::permissions(path, fs::perms(0444));
  EXPECT_THAT(refusal([&] { write_text(path, "newer"); }), HasSubstr("read-only"));
  EXPECT_EQ(read_text(path), "new");
}

TEST(File, OneNameForTwoFilesIsRefused) {
  const TemporaryFolder folder;
  const std::vector<fs::path> targets{folder / "a.txt", folder / "b" / ".." / "a.txt"};
  fs::create_directory(folder / "b");
  EXPECT_THAT(refusal([&] { check_writable(targets); }), HasSubstr("twice"));
  EXPECT_THAT(refusal([&] { write_atomically(targets, [](std::span<const fs::path>) {}); }),
              HasSubstr("twice"));
}

TEST(File, WhenOneOfSeveralCannotTakeItsPlaceTheOthersAreAsBefore) {
  const TemporaryFolder folder;
  const std::vector<fs::path> targets{folder / "a.txt", folder / "b.txt", folder / "c.txt"};
  write_text(targets[2], "old");
  const auto write = [&](std::span<const fs::path> temporaries) {
    for (const fs::path& temporary : temporaries) std::ofstream(temporary) << "new";
    fs::create_directory(targets[1]);  // in the way, once it is too late to ask
    write_text(targets[1] / "x", "");
  };
  EXPECT_NE(refusal([&] { write_atomically(targets, write); }), "");
  EXPECT_EQ(read_text(targets[2]), "old");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("b.txt", "c.txt"));
}

const auto kText = [](const std::string& name) { return name.ends_with(".txt"); };

TEST(File, AFolderIsReplacedAsAWhole) {
  const TemporaryFolder folder;
  const fs::path target = folder / "parts";
  const auto put = [](const std::string& names, const std::string& text) {
    return [names, text](const fs::path& made) {
      for (const char name : names) write_text(made / (std::string(1, name) + ".txt"), text);
    };
  };
  write_folder_atomically(target, put("abc", "old"), kText);
  EXPECT_THAT(names_in(target), ElementsAre("a.txt", "b.txt", "c.txt"));
  write_text(target / "mine.md", "keep");
  const auto fail = [&](const fs::path& made) {
    put("a", "half")(made);
    throw Error("it broke");
  };
  EXPECT_EQ(refusal([&] { write_folder_atomically(target, fail, kText); }), "it broke");
  EXPECT_EQ(read_text(target / "a.txt"), "old");
  write_folder_atomically(target, put("ab", "new"), kText);
  EXPECT_THAT(names_in(target), ElementsAre("a.txt", "b.txt", "mine.md"));
  EXPECT_EQ(read_text(target / "a.txt") + read_text(target / "mine.md"), "newkeep");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("parts"));
  fs::create_directory(target / "sub");
  EXPECT_THAT(refusal([&] { write_folder_atomically(target, put("ab", "newer"), kText); }), HasSubstr("sub"));
  EXPECT_EQ(read_text(target / "a.txt"), "new");
}

/// A process that is ended by `signal` in the middle of writing a file, and of a folder.
void end_while_writing(const fs::path& folder, int signal) {
  const pid_t child = fork();
  if (child == 0) {
    remove_temporaries_on_signals();
    write_folder_atomically(
        folder / "parts",
        [&](const fs::path& made) {
          std::ofstream(made / "a.txt") << "half";
          write_atomically(folder / "a.txt", [&](const fs::path& temporary) {
            std::ofstream(temporary) << "half";
            kill(getpid(), signal);
            pause();
          });
        },
        kText);
    _exit(3);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), signal);
}

TEST(File, SignalsLeaveNothingAndWhatAKilledProcessLeftIsSwept) {
  const TemporaryFolder folder;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    end_while_writing(folder.path(), signal);
    EXPECT_THAT(names_in(folder.path()), ElementsAre()) << signal;
  }
  end_while_writing(folder.path(), SIGKILL);
  EXPECT_EQ(names_in(folder.path()).size(), 2u);
  write_atomically(folder / "b.txt", [&](const fs::path& temporary) {
    EXPECT_EQ(names_in(folder.path()).size(), 1u);  // the others are gone, ours is locked
    end_while_writing(folder.path(), SIGTERM);
    std::ofstream(temporary) << "whole";
  });
  EXPECT_THAT(names_in(folder.path()), ElementsAre("b.txt"));
  EXPECT_EQ(read_text(folder / "b.txt"), "whole");
}

TEST(File, ALinkIsFollowedNotReplaced) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "real");
  write_text(folder / "real" / "a.txt", "old");
  fs::create_symlink("real/a.txt", folder / "link.txt");
  write_text(folder / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(read_text(folder / "real" / "a.txt"), "new");
}

TEST(File, WhatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const auto write_to = [](const fs::path& path) { return refusal([&] { write_text(path, "x"); }); };
  EXPECT_THAT(write_to(folder / "no" / "a.txt"), HasSubstr("does not exist"));
  fs::create_directory(folder / "b.txt");
  EXPECT_THAT(write_to(folder / "b.txt"), HasSubstr("is a folder"));
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(write_to(folder / "pipe"), HasSubstr("device or pipe"));
  EXPECT_THAT(write_to("/dev/full"), HasSubstr("/dev/full: cannot be written"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  write_text(folder / "file", "x");
  EXPECT_THAT(write_to(folder / "file" / "a.txt"), HasSubstr("a.txt: cannot be written"));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("b.txt", "file", "pipe"));
}

TEST(File, AFullDiskLeavesTheOlderFileAndNothingElse) {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "old");
  std::string message;
  {
    const test::FullDisk disk(1000);
    message = refusal([&] { write_text(folder / "a.txt", std::string(5000, 'x')); });
  }
  EXPECT_THAT(message, HasSubstr("a.txt: cannot"));
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.txt"));
}

TEST(File, AFolderStandsForItsFilesInNaturalOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"f10.png", "f2.PNG", "f1.png", "f02.png", ".hidden.png", "f3.txt", "g.jpg"})
    write_text(folder / name, "");
  fs::create_directory(folder / "folder.png");
  fs::create_symlink("nowhere", folder / "broken.png");
  const std::vector<std::string> extensions{".png", ".jpg"};
  std::vector<std::string> names;
  for (const fs::path& path : expand_inputs({folder.path(), folder / "f3.txt"}, extensions))
    names.push_back(path.filename().string());
  EXPECT_THAT(names, ElementsAre("f1.png", "f2.PNG", "f02.png", "f10.png", "g.jpg", "f3.txt"));
}

TEST(File, InputsThatAreMissingOrEmptyAreNamed) {
  const TemporaryFolder folder;
  const std::vector<std::string> extensions{".png", ".jpg"};
  EXPECT_THAT(refusal([&] { expand_inputs({folder / "none"}, extensions); }),
              HasSubstr("none: no such file"));
  EXPECT_THAT(refusal([&] { expand_inputs({folder.path()}, extensions); }), HasSubstr(".png, .jpg"));
}

TEST(File, ExtensionsAreLowerCase) {
  EXPECT_EQ(extension_of("a/b.c/D.PnG"), ".png");
  EXPECT_EQ(extension_of("a.b/none"), "");
}

}  // namespace
}  // namespace sateen::io
