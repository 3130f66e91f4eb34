/* A plugin for QEMU that counts the guest's instructions between two marks.
 *
 *     cc -O2 -shared -fPIC -o count.so count.c
 *     qemu-... -plugin ./count.so,begin=ADDRESS,end=ADDRESS -d plugin -D LOG
 *
 * An instruction at the one address begins the counting, one at the other ends it, any number
 * of times; at its end the sum goes to the log. The header of the plugin interface is not
 * always packaged with the emulator, so what is used of its version 1 is declared here. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef uint64_t qemu_plugin_id_t;

size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *, size_t);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *);
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t,
    void (*)(qemu_plugin_id_t, struct qemu_plugin_tb *));
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *, int, void *, uint64_t);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *,
    void (*)(unsigned int, void *), int, void *);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, void *), void *);
void qemu_plugin_outs(const char *);

enum { ADD = 0, NO_REGISTERS = 0 };

__attribute__((visibility("default"))) int qemu_plugin_version = 1;

static uint64_t begin_at, end_at;     /* the marks */
static uint64_t executed;             /* all instructions so far */
static uint64_t begun, between;       /* as of the last begin; the sum */

static void begins(unsigned int cpu, void *unused)
{
    begun = executed;
}

static void ends(unsigned int cpu, void *unused)
{
    between += executed - begun;
}

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb *block)
{
    size_t count = qemu_plugin_tb_n_insns(block);
    for (size_t i = 0; i < count; i++) {
        struct qemu_plugin_insn *insn = qemu_plugin_tb_get_insn(block, i);
        uint64_t at = qemu_plugin_insn_vaddr(insn);
        if (at == begin_at || at == end_at)
            qemu_plugin_register_vcpu_insn_exec_cb(insn, at == begin_at ? begins : ends,
                NO_REGISTERS, NULL);
        qemu_plugin_register_vcpu_insn_exec_inline(insn, ADD, &executed, 1);
    }
}

static void over(qemu_plugin_id_t id, void *unused)
{
    char line[64];
    snprintf(line, sizeof line, "COUNTED %llu\n", (unsigned long long)between);
    qemu_plugin_outs(line);
}

__attribute__((visibility("default")))
int qemu_plugin_install(qemu_plugin_id_t id, const void *info, int argc, char **argv)
{
    for (int i = 0; i < argc; i++) {
        if (strncmp(argv[i], "begin=", 6) == 0)
            begin_at = strtoull(argv[i] + 6, NULL, 0);
        else if (strncmp(argv[i], "end=", 4) == 0)
            end_at = strtoull(argv[i] + 4, NULL, 0);
        else
            return -1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, over, NULL);
    return 0;
}
