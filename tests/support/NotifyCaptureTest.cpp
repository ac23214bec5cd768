// SPDX-License-Identifier: MIT
#include <support/NotifyCapture.h>

#include <gtest/gtest-spi.h>

using support::NotifyCapture;
using Lines = NotifyCapture::Lines;

TEST(NotifyCapture, takenWarningsAreExactAndDoNotFail)
{
    NotifyCapture capture;
    OSG_WARN << "first" << std::endl;
    OSG_WARN << "second\nthird\n";
    EXPECT_EQ(capture.takeWarnings(), (Lines{"first", "second", "third"}));
    EXPECT_EQ(capture.takeWarnings(), Lines());
}

TEST(NotifyCapture, warningThatNobodyTookFailsTheTest)
{
    EXPECT_NONFATAL_FAILURE(
        {
            NotifyCapture capture;
            OSG_WARN << "surprise\n";
        },
        "unexpected warning: surprise");
}

TEST(NotifyCapture, quieterMessagesAreNoFailure)
{
    NotifyCapture capture(osg::INFO);
    OSG_INFO << "a hint\n";
    EXPECT_EQ(capture.takeMessages(), Lines{"a hint"});
}

TEST(NotifyCapture, previousHandlerAndLevelComeBack)
{
    const osg::NotifySeverity level = osg::getNotifyLevel();
    osg::NotifyHandler* handler = osg::getNotifyHandler();
    {
        NotifyCapture capture(osg::DEBUG_FP);
        EXPECT_NE(osg::getNotifyHandler(), handler);
    }
    EXPECT_EQ(osg::getNotifyHandler(), handler);
    EXPECT_EQ(osg::getNotifyLevel(), level);
}
