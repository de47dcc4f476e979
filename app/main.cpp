#include "app/session.hpp"
#include "app/system/environment.hpp"

int main(int argc, char** argv) {
    tendril::app::end_session_on_signals();
    return tendril::app::run_command_line(tendril::app::begin_program(argc, argv));
}
