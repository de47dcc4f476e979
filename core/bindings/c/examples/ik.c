/* A leg in closed form, its knee towards a pole ahead: */
#include <stdio.h>
#include <tendril/c.h>

int main(void) {
    tendril_ik_two_bone_limb leg = tendril_ik_two_bone_limb_default();
    tendril_ik_two_bone_options options = tendril_ik_two_bone_options_default();
    tendril_ik_two_bone_result posed = tendril_ik_two_bone_result_default();
    const tendril_vec3f step = {0.1f, 0.15f, 0.2f}, hip = {0.1f, 0.9f, 0}, ankle = {0.1f, 0.05f, 0};
    tendril_error error;
    leg.root = hip, leg.mid.x = 0.1f, leg.mid.y = 0.47f, leg.mid.z = 0.02f, leg.tip = ankle;
    leg.upper = 0.44f, leg.lower = 0.42f;
    options.pole.x = 0.1f, options.pole.y = 0.5f, options.pole.z = 1;
    if (tendril_ik_two_bone(&leg, step, &options, &posed, &error)) return printf("%s\n", error.message), 1;
    printf("%s, knee at %.3f %.3f %.3f\n", tendril_ik_status_name(posed.status), posed.mid.x, posed.mid.y,
           posed.mid.z);
    return 0;
}
