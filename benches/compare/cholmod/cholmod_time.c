/* Times CHOLMOD (supernodal, with the BLAS it is linked to) on a matrix written by
 *   cargo run --release -p asperity-benches --example direct_solver -- dump CASE FILE
 *
 *   cholmod_time FILE THREADS RUNS ORDERING      ORDERING: amd, metis, or best (CHOLMOD's own choice of several)
 *
 * Prints the least wall time of each phase over RUNS; 0 RUNS: one, without a second factorisation. Threads are those of OpenBLAS; this CHOLMOD has no others. */
#include <cholmod.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

extern void openblas_set_num_threads(int);

/* Wall time and time of all processors. */
typedef struct {
    double wall, processors;
} times;

static double seconds(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static times now(void) {
    times t = {seconds(CLOCK_MONOTONIC), seconds(CLOCK_PROCESS_CPUTIME_ID)};
    return t;
}

static times least(times a, times from, times to) {
    times b = {fmin(a.wall, to.wall - from.wall), fmin(a.processors, to.processors - from.processors)};
    return b;
}

static int read_exactly(FILE *file, void *to, size_t size, size_t count) {
    return fread(to, size, count, file) == count;
}

static cholmod_sparse *read_matrix(const char *name, cholmod_common *c) {
    FILE *file = fopen(name, "rb");
    uint64_t head[2];
    if (!file || !read_exactly(file, head, 8, 2)) return NULL;
    /* stype -1: the lower triangle is stored. */
    cholmod_sparse *a = cholmod_l_allocate_sparse(head[0], head[0], head[1], 1, 1, -1, CHOLMOD_REAL, c);
    int complete = a && read_exactly(file, a->p, 8, head[0] + 1) && read_exactly(file, a->i, 8, head[1]) &&
                   read_exactly(file, a->x, 8, head[1]);
    fclose(file);
    return complete ? a : NULL;
}

static cholmod_dense *loads(size_t n, size_t columns, cholmod_common *c) {
    cholmod_dense *b = cholmod_l_zeros(n, columns, CHOLMOD_REAL, c);
    for (size_t j = 0; j < columns; j++)
        for (size_t i = 0; i < n; i++) ((double *)b->x)[j * n + i] = sin(0.7 * (double)(i + j));
    return b;
}

int main(int argc, char **argv) {
    if (argc != 5) {
        fprintf(stderr, "usage: cholmod_time FILE THREADS RUNS amd|metis|best\n");
        return 2;
    }
    int threads = atoi(argv[2]), runs = atoi(argv[3]);
    cholmod_common common, *c = &common;
    cholmod_l_start(c);
    openblas_set_num_threads(threads);
    c->supernodal = CHOLMOD_SUPERNODAL;
    if (strcmp(argv[4], "best") != 0) {
        c->nmethods = 1;
        c->method[0].ordering = strcmp(argv[4], "metis") == 0 ? CHOLMOD_METIS : CHOLMOD_AMD;
        c->postorder = 1;
    }
    cholmod_sparse *a = read_matrix(argv[1], c);
    if (!a) {
        fprintf(stderr, "%s: no matrix\n", argv[1]);
        return 1;
    }
    times none = {INFINITY, INFINITY}, analyse = none, first = none, again = none, solve = none, many = none;
    double nnz = 0;
    for (int run = 0; run < (runs > 0 ? runs : 1); run++) {
        times t0 = now();
        cholmod_factor *l = cholmod_l_analyze(a, c);
        times t1 = now();
        cholmod_l_factorize(a, l, c);
        times t2 = now();
        if (runs > 0) cholmod_l_factorize(a, l, c);
        times t3 = now();
        if (c->status != CHOLMOD_OK) {
            fprintf(stderr, "status %d\n", c->status);
            return 1;
        }
        cholmod_dense *b = loads(a->nrow, 1, c), *x = NULL, *y = NULL, *e = NULL;
        times t4 = now();
        cholmod_l_solve2(CHOLMOD_A, l, b, NULL, &x, NULL, &y, &e, c);
        times t5 = now();
        cholmod_dense *b64 = loads(a->nrow, 64, c), *x64 = NULL;
        times t6 = now();
        cholmod_l_solve2(CHOLMOD_A, l, b64, NULL, &x64, NULL, &y, &e, c);
        times t7 = now();
        nnz = (double)c->lnz;
        analyse = least(analyse, t0, t1);
        first = least(first, t1, t2);
        again = least(again, t2, t3);
        solve = least(solve, t4, t5);
        many = least(many, t6, t7);
        cholmod_l_free_dense(&b, c);
        cholmod_l_free_dense(&x, c);
        cholmod_l_free_dense(&b64, c);
        cholmod_l_free_dense(&x64, c);
        cholmod_l_free_dense(&y, c);
        cholmod_l_free_dense(&e, c);
        cholmod_l_free_factor(&l, c);
    }
    printf("cholmod/%-5s %s threads %d n %7zu nnz(L) %8.3fM", argv[4], argv[1], threads, (size_t)a->nrow, nnz / 1e6);
    const char *names[] = {"analyse", "factor", "again", "solve", "solve64"};
    times all[] = {analyse, first, again, solve, many};
    for (int k = 0; k < 5; k++) printf("  %s %.4f (%.4f)", names[k], all[k].wall, all[k].processors);
    printf("\n");
    cholmod_l_free_sparse(&a, c);
    cholmod_l_finish(c);
    return 0;
}
