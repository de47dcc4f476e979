// Labs that re-read files when a scene is opened: which faults are the scene's, and which the file's.
#include "app/document/atomic_file.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

struct Reader {
    const char* lab;
    const char* command;
    const char* number;  ///< in the lab's JSON
    const char* name;    ///< name of an object in the file
};

class ReadsAFile : public LabTest, public testing::WithParamInterface<Reader> {
  protected:
    ReadsAFile() : LabTest(GetParam().lab) {
        std::filesystem::copy_file(test::source_path("tests/app/golden/faulty_walk.bvh"), file_);
        run(GetParam().command, {{"path", file_.string()}});
        saved_ = save_scene(workspace)["labs"][GetParam().lab];
    }
    std::string opened() const { return opened_with("", saved_); }
    const test::TempFolder folder_;
    const std::filesystem::path file_ = folder_ / "walk.bvh";
    Json saved_;
};

TEST_P(ReadsAFile, AnInvalidValueIsRefusedAndABadFileLeavesTheLabBlank) {
    const Reader& of = GetParam();
    EXPECT_EQ(opened(), "");
    for (const char* pointer : {of.number, of.name}) {
        std::string place = std::string("labs.") + of.lab + pointer;
        std::ranges::replace(place, '/', '.');
        const std::string why = opened_with(pointer, pointer == of.number ? Json(-1e9) : Json("wing"));
        EXPECT_TRUE(why.starts_with(place + ": ")) << why;
        EXPECT_TRUE(test::says(why, pointer == of.number ? "-1000000000.0" : "wing"));
    }
    test::write(file_, "HIERARCHY\nROOT");
    EXPECT_TRUE(opened().starts_with("blank: walk.bvh, line 2: ")) << opened();
    std::filesystem::remove(file_);
    EXPECT_TRUE(test::says(opened(), "blank: walk.bvh is missing, at " + shown_path(file_)));
}

INSTANTIATE_TEST_SUITE_P(
    OfEachKind, ReadsAFile,
    testing::Values(Reader{"humanoid", "humanoid.load", "/ik/foot_ik/enter_speed", "/bones/Hips"},
                    Reader{"humanoid", "humanoid.motion.load", "/edits/0/scale", "/edits/0/clip"},
                    Reader{"rope", "rope.character", "/character/began", "/character/clip"}));

}  // namespace
}  // namespace tendril::app
