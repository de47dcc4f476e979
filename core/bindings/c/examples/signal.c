/* A camera that follows on a spring of 2 Hz, at 60 frames a second: */
#include <stdio.h>
#include <tendril/c.h>

int main(void) {
    tendril_signal_spring spring = tendril_signal_spring_default();
    tendril_signal_spring_state state = tendril_signal_spring_state_default();
    tendril_error error;
    double height = 0;
    int frame;
    spring.strength = 2;
    for (frame = 0; frame < 120; ++frame)
        if (tendril_signal_spring_step(&spring, &state, frame < 60 ? 0 : 1.5, 1.0 / 60, &height, &error))
            return printf("%s\n", error.message), 1;
    printf("%.3f m after a second\n", height);
    return 0;
}
