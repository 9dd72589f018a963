// The first minute: glint alone, a folder, a name that is mistyped, a new scene.
#include "live.h"

#include <cstdlib>

namespace glint::window::start_test {
namespace {

class Start : public Window {
protected:
    bool has_title(std::string_view title) const {
        return eventually([&] { return screen_->title() == title; });
    }
    // The page stands: the button for a new scene has its colour in a corner without letters.
    static constexpr Colour kButton{48, 94, 132};
    static constexpr glm::ivec2 kCorner{100, 64};
    void start_page(const std::vector<std::string>& arguments) {
        start(arguments);
        ASSERT_TRUE(shows(kButton, kCorner));
        EXPECT_EQ(screen_->title(), "Glint");
    }
};

TEST_F(Start, AloneItShowsWhatThereIsToOpenAndRemembersIt) {
    write(folder_->path() / "red.frag", flat({200, 30, 20}));
    start_page({});
    EXPECT_EQ(glint_->errors(), "");
    ASSERT_TRUE(screen_->drop((folder_->path() / "red.frag").string()));
    ASSERT_TRUE(glint_->says("red.frag: shown"));
    ASSERT_TRUE(shows({200, 30, 20}));
    screen_->tap("Control_L+q");
    EXPECT_EQ(glint_->wait().code, 0);
    EXPECT_EQ(read(folder_->path() / "home/.local/state/glint/recent"),
              (fs::canonical(folder_->path()) / "red.frag").string() + "\n");
}

TEST_F(Start, AFolderIsShownToChooseFrom) {
    fs::create_directory(folder_->path() / "looks");
    write(folder_->path() / "looks/red.frag", flat({200, 30, 20}));
    start_page({(folder_->path() / "looks").string()});
    // The only card stands below the bar, the invitation and a heading, from the left edge on.
    screen_->click({120, 200});
    ASSERT_TRUE(glint_->says("red.frag: shown")) << glint_->errors();
    EXPECT_TRUE(shows({200, 30, 20}));
}

TEST_F(Start, AFolderThatIsDroppedLeavesTheSceneOpen) {
    open(flat({10, 20, 30}));
    fs::create_directory(folder_->path() / "looks");
    write(folder_->path() / "looks/red.frag", flat({200, 30, 20}));
    ASSERT_TRUE(screen_->drop((folder_->path() / "looks").string()));
    settle();
    EXPECT_TRUE(shows({10, 20, 30}));
    EXPECT_TRUE(glint_->runs());
}

TEST_F(Start, AMistypedNameEndsAtOnceWith4) {
    write(scene(), flat({1, 2, 3}));
    glint_ = std::make_unique<Glint>(screen_->name(), folder_->path(),
                                     std::vector<std::string>{"scnee.frag"});
    EXPECT_EQ(glint_->wait().code, 4);
    EXPECT_NE(glint_->errors().find("did you mean 'scene.frag'?"), std::string::npos)
        << glint_->errors();
}

TEST_F(Start, NewWritesASceneAndOpensIt) {
    start({"new", "rings", "--from", "feedback"});
    ASSERT_TRUE(glint_->says("rings.frag: shown")) << glint_->errors();
    EXPECT_TRUE(has_title("rings - Glint"));
    // It is edited as any other.
    write(folder_->path() / "rings.frag", flat({40, 50, 60}));
    EXPECT_TRUE(shows({40, 50, 60}));
}

TEST_F(Start, TheNewButtonWritesASceneAndOpensIt) {
    start_page({});
    screen_->click({140, 70});  // New scene…
    // Behind the dialog the page is dim.
    ASSERT_TRUE(eventually([&] { return screen_->pixel(kCorner) != kButton; }));
    settle();
    screen_->tap("Control_L+a");
    screen_->type("pond");
    settle();
    screen_->tap("Return");
    ASSERT_TRUE(glint_->says("pond.frag: shown")) << glint_->errors();
    EXPECT_TRUE(has_title("pond - Glint"));
    EXPECT_FALSE(read(folder_->path() / "pond.frag").empty());
}

}  // namespace
}  // namespace glint::window::start_test
