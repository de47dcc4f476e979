#include "app/command_line.hpp"
#include "app/session.hpp"

int main(int argc, char** argv) {
    tendril::app::end_session_on_signals();
    return tendril::app::run_command_line(argc, argv);
}
