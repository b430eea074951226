// Fast input is distributed over frames so that text fields do not miss any of it.
#include "app/window/input_queue.h"

#include <gtest/gtest.h>

#include <string>

namespace hooke {
namespace {

using Kind = QueuedInput::Kind;

class Typist {
 public:
  void add(Kind kind, int key, const std::string& name) {
    queue_.add({kind, key, [this, name] { seen_ += name + " "; }});
  }
  // An editing key, pressed and released.
  void edit(int key) {
    add(Kind::Edit, key, "press" + std::to_string(key));
    add(Kind::Release, key, "release" + std::to_string(key));
  }
  // A letter key with the character that it types.
  void type(char letter) {
    add(Kind::Press, letter, std::string("press ") + letter);
    add(Kind::Text, 0, std::string(1, letter));
    add(Kind::Release, letter, std::string("release ") + letter);
  }
  std::string frame() {
    seen_.clear();
    queue_.apply_frame();
    return seen_;
  }

 private:
  InputQueue queue_;
  std::string seen_;
};

TEST(InputQueue, AKeyPressedAndReleasedWithinAFrameStaysDownForOneFrame) {
  Typist typist;
  typist.edit(1);
  EXPECT_EQ(typist.frame(), "press1 ");
  EXPECT_EQ(typist.frame(), "release1 ");
  EXPECT_EQ(typist.frame(), "");
}

TEST(InputQueue, TheSameKeyTwiceIsReportedTwice) {
  Typist typist;
  typist.edit(1);
  typist.edit(1);
  int presses = 0;
  for (int i = 0; i < 6; ++i) presses += typist.frame().find("press1") != std::string::npos ? 1 : 0;
  EXPECT_EQ(presses, 2);
}

TEST(InputQueue, TwoEditingKeysAreReportedInTwoFramesInOrder) {
  Typist typist;
  typist.add(Kind::Edit, 1, "left");
  typist.add(Kind::Edit, 2, "backspace");
  EXPECT_EQ(typist.frame(), "left ");
  EXPECT_EQ(typist.frame(), "backspace ");
}

TEST(InputQueue, ACharacterAfterAnEditingKeyIsReportedOneFrameLater) {
  Typist typist;
  typist.add(Kind::Text, 0, "a");
  typist.add(Kind::Edit, 1, "backspace");
  typist.add(Kind::Text, 0, "b");
  EXPECT_EQ(typist.frame(), "a backspace ");
  EXPECT_EQ(typist.frame(), "b ");
}

TEST(InputQueue, OtherInputKeepsItsOrder) {
  Typist typist;
  typist.edit(1);
  typist.add(Kind::Other, 0, "click");
  EXPECT_EQ(typist.frame(), "press1 ");
  EXPECT_EQ(typist.frame(), "release1 click ");
}

// Ctrl+A, as fast as programs type it: Ctrl is up before A is.
TEST(InputQueue, AModifierReleasedWithinTheFrameOfAnEditingKeyStaysDownWithIt) {
  Typist typist;
  typist.add(Kind::Press, 341, "ctrl");
  typist.add(Kind::Edit, 'A', "a");
  typist.add(Kind::Release, 341, "no_ctrl");
  typist.add(Kind::Release, 'A', "no_a");
  EXPECT_EQ(typist.frame(), "ctrl a ");
  EXPECT_EQ(typist.frame(), "no_ctrl no_a ");
}

TEST(InputQueue, LettersTypedWithinAFrameAreReportedTogether) {
  Typist typist;
  typist.type('a');
  typist.type('a');
  EXPECT_EQ(typist.frame(), "press a a release a press a a release a ");
}

}  // namespace
}  // namespace hooke
