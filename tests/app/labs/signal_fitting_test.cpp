// A fit computed in shares, one per tick, as in the window.
#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class SignalFitting : public LabTest {
  protected:
    SignalFitting() : LabTest(signal_lab) {
        run("signal.input", {{"kind", "square"}, {"period", 2}});
        run("signal.filter.add", {{"kind", "rate_limit"}, {"rise", 4}});
        draw();
    }
    const SignalPart& part() const { return signal_part(workspace); }
    void draw() {
        run("signal.fit.draw", {{"from", 0.2}, {"from_value", -0.5}, {"to", 0.6}, {"to_value", 0.7}});
    }
    /// Runs up to `most` ticks, or to the end; returns how many there were.
    int work(int most = 10'000) {
        int ticks = 0;
        for (; ticks < most && lab().working(workspace); ++ticks) lab().work(workspace);
        return ticks;
    }
    static void expect_same(const std::vector<Fit>& a, const std::vector<Fit>& b) {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_EQ(a[i].filter, b[i].filter) << i;
            EXPECT_EQ(a[i].residual, b[i].residual) << i;
        }
    }
};

TEST_F(SignalFitting, InSharesItIsWhatItIsAtOnce) {
    Workspace other = workspace;
    run("signal.fit");
    EXPECT_FALSE(lab().working(workspace)) << "a script's next line finds it done";
    const std::vector<Fit> at_once = part().fits;
    ASSERT_EQ(at_once.size(), signal::kinds().size());

    workspace = other;
    begin("signal.fit");
    EXPECT_TRUE(lab().working(workspace));
    EXPECT_TRUE(part().fits.empty());
    EXPECT_GT(work(), 2 * static_cast<int>(signal::kinds().size()));
    expect_same(part().fits, at_once);
    EXPECT_FALSE(part().fitting);

    // Discarding the search, or saving and loading it half way, loses nothing.
    workspace = other;
    begin("signal.fit");
    int ticks = 0;
    for (; lab().working(workspace); ++ticks) {
        if (ticks % 3 == 1) workspace.runtimes.clear();
        if (ticks % 7 == 2) {
            const auto loaded = part().load(part().save(), "labs.signal");
            ASSERT_TRUE(dynamic_cast<const SignalPart&>(*loaded) == part()) << ticks;
            workspace.document.set(signal_lab, loaded);
        }
        lab().work(workspace);
    }
    expect_same(part().fits, at_once);
}

TEST_F(SignalFitting, SearchesBeginWithTheChainAsItWas) {
    run("signal.fit");
    const std::vector<Fit> at_once = part().fits;
    begin("signal.fit");
    work(5);
    run("signal.filter.set", {{"at", 1}, {"rise", 900}});
    run("signal.filter.remove", {{"at", 0}});
    work();
    expect_same(part().fits, at_once);
}

TEST_F(SignalFitting, IsCancelledAndWhatIsFittedStays) {
    EXPECT_NE(refused("signal.fit.cancel").find("no fit is running"), std::string::npos);
    begin("signal.fit");
    while (part().fits.size() < 4) lab().work(workspace);
    run("signal.fit.cancel");
    EXPECT_FALSE(lab().working(workspace));
    EXPECT_EQ(part().fits.size(), 4u);
    for (std::size_t i = 1; i < part().fits.size(); ++i)
        EXPECT_LE(part().fits[i - 1].residual, part().fits[i].residual) << "ranked";
    run("signal.fit.use", {{"rank", 0}});
    EXPECT_EQ(part().stages.size(), 1u);
}

TEST_F(SignalFitting, EndsWhereItsResponseChanges) {
    const std::pair<const char*, Json> changes[] = {
        {"signal.fit.draw", {{"from", 0}, {"from_value", 0}, {"to", 0.1}, {"to_value", 1}}},
        {"signal.fit.clear", Json::object()},
        {"signal.fit.record", Json::object()},
        {"signal.preset", {{"name", "spring"}}}};
    for (const auto& [command, arguments] : changes) {
        draw();
        begin("signal.fit");
        work(3);
        ASSERT_TRUE(lab().working(workspace));
        run(command, arguments);
        EXPECT_FALSE(lab().working(workspace)) << command;
        run("undo");
        EXPECT_TRUE(lab().working(workspace)) << command << " is undone, and the fit goes on";
        work();
        EXPECT_EQ(part().fits.size(), signal::kinds().size());
    }
}

TEST_F(SignalFitting, ItsProgressIsTold) {
    test::PanelReader reader;
    begin("signal.fit");
    while (part().fits.size() < 2) lab().work(workspace);
    EXPECT_EQ(state().at("fitting"), true);
    const std::string running = reader.inspector(lab(), workspace);
    EXPECT_TRUE(test::says(running, "2 14")) << running;
    EXPECT_NE(running.find("Cancel"), std::string::npos) << running;
    work();
    EXPECT_EQ(state().at("fitting"), false);
    const std::string done = reader.inspector(lab(), workspace);
    EXPECT_EQ(done.find("kinds of filter fitted"), std::string::npos) << done;
    EXPECT_EQ(done.find("Cancel"), std::string::npos) << done;
}

TEST_F(SignalFitting, FilesThatCannotGoOnAreRefused) {
    begin("signal.fit");
    work(3);
    const Json saved = part().save();
    const auto expect_place = [&](const char* pointer, const Json& value, const char* says) {
        Json broken = saved;
        broken[Json::json_pointer(pointer)] = value;
        try {
            part().load(broken, "labs.signal");
            ADD_FAILURE() << pointer << " was read";
        } catch (const std::runtime_error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(says)) << error.what();
        }
    };
    expect_place("/fit/fitting/shares", -1, "labs.signal.fit.fitting.shares");
    expect_place("/fit/fitting/shares", 1e6, "labs.signal.fit.fitting.shares");
    expect_place("/fit/fitting/from", 3, "labs.signal.fit.fitting.from");
    expect_place("/fit/fitting/from/0/kind", "sponge", "labs.signal.fit.fitting.from.0.kind");
    Json rank = Json::array();
    for (const signal::Kind& kind : signal::kinds())
        rank.push_back({{"filter", {{"kind", kind.name}}}, {"residual", 1}});
    expect_place("/fit/ranking", rank, "labs.signal.fit.fitting");
}

}  // namespace
}  // namespace tendril::app
