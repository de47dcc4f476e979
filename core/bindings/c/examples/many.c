/* A thousand tentacles of eight bones reach for their own points: */
#include <stdio.h>
#include <tendril/c.h>

enum { CHAINS = 1000 };

int main(void) {
    static tendril_vec3f targets[CHAINS];
    tendril_ik_many_summary summary = tendril_ik_many_summary_default();
    tendril_ik_many_report report = tendril_ik_many_report_default();
    tendril_ik_batch batch;
    tendril_error error;
    size_t i;
    for (i = 0; i < CHAINS; ++i) targets[i].x = 2 + 0.004f * (float)i, targets[i].y = 1, targets[i].z = 2;
    if (tendril_ik_batch_make(CHAINS, 8, 1, &batch, &error) ||
        tendril_ik_batch_solve(batch, targets, CHAINS, NULL, NULL, &summary, &error) ||
        tendril_ik_batch_report(batch, 7, &report, &error))
        return printf("%s\n", error.message), 1;
    printf("%d refused; chain 7: %s\n", (int)summary.invalid, tendril_ik_status_name(report.status));
    tendril_ik_batch_destroy(batch);
    return 0;
}
