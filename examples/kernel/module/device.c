// SPDX-License-Identifier: GPL-2.0
/*
 * /dev/nostray: reading it renders a picture, row by row, and gives it as PPM.
 *
 * Each open file is a picture of its own. The picture lies in memory that is allocated here; the
 * Rust half (nostray_core.o) computes in integers only, so no floating-point state is touched.
 * When the last pixel has been read, the SHA-256 of the file and the depth of the kernel's
 * stack that rendering used go to the log.
 */
#define pr_fmt(fmt) KBUILD_MODNAME ": " fmt

#include <crypto/sha2.h>
#include <linux/fs.h>
#include <linux/miscdevice.h>
#include <linux/mm.h>
#include <linux/module.h>
#include <linux/mutex.h>
#include <linux/sched/signal.h>
#include <linux/sched/task_stack.h>
#include <linux/slab.h>
#include <linux/uaccess.h>

size_t nostray_picture_size(void);
size_t nostray_picture_align(void);
int nostray_picture_begin(void *at, bool wide, u32 width, u32 height);
u32 nostray_picture_render(void *at, u8 *bytes, u32 pixels);

#define WIDTH_MAX 4096
#define PAINT 0x5afec01a5afec01aUL
/* What lies between a frame and the painted stack below it. */
#define MARGIN 256

static uint width = 160;
module_param(width, uint, 0644);
MODULE_PARM_DESC(width, "pixels in a row");

static uint height = 120;
module_param(height, uint, 0644);
MODULE_PARM_DESC(height, "rows");

static bool wide;
module_param(wide, bool, 0644);
MODULE_PARM_DESC(wide, "numbers of 64 bits (Q32.32) instead of 32 (Q16.16)");

struct picture {
	struct mutex lock;
	void *render;
	uint width;
	uint height;
	bool wide;
	/* What has been rendered and not been read: the head of the file, then a row at a time. */
	u8 *buffer;
	size_t at;
	size_t length;
	struct sha256_state hash;
	bool done;
	unsigned long stack;
};

/* Paints the kernel's stack from its end up to shortly below this frame. */
static noinline void stack_paint(void)
{
	unsigned long *at = (unsigned long *)end_of_stack(current) + 1;
	unsigned long *to = (unsigned long *)((unsigned long)__builtin_frame_address(0) - MARGIN);

	while (at < to)
		WRITE_ONCE(*at++, PAINT);
}

/* How much of the stack has been used since, counted from its beginning. */
static noinline unsigned long stack_used(void)
{
	unsigned long *at = (unsigned long *)end_of_stack(current) + 1;
	unsigned long top = (unsigned long)task_stack_page(current) + THREAD_SIZE;

	while ((unsigned long)at < top && READ_ONCE_NOCHECK(*at) == PAINT)
		at++;
	return top - (unsigned long)at;
}

static void picture_free(struct picture *picture)
{
	kvfree(picture->render);
	kvfree(picture->buffer);
	kfree(picture);
}

static int nostray_open(struct inode *inode, struct file *file)
{
	struct picture *picture = kzalloc(sizeof(*picture), GFP_KERNEL);

	if (!picture)
		return -ENOMEM;
	mutex_init(&picture->lock);
	picture->width = READ_ONCE(width);
	picture->height = READ_ONCE(height);
	picture->wide = READ_ONCE(wide);
	if (picture->width == 0 || picture->width > WIDTH_MAX) {
		kfree(picture);
		return -EINVAL;
	}
	/* The head of the file is shorter than 32 bytes and needs no more room than that. */
	picture->buffer = kvmalloc(max(3 * picture->width, 32u), GFP_KERNEL);
	picture->render = kvmalloc(nostray_picture_size(), GFP_KERNEL);
	if (!picture->buffer || !picture->render) {
		picture_free(picture);
		return -ENOMEM;
	}
	if (nostray_picture_begin(picture->render, picture->wide, picture->width,
				  picture->height)) {
		picture_free(picture);
		return -EINVAL;
	}
	picture->length = scnprintf(picture->buffer, 32, "P6\n%u %u\n255\n", picture->width,
				    picture->height);
	sha256_init(&picture->hash);
	sha256_update(&picture->hash, picture->buffer, picture->length);
	file->private_data = picture;
	return stream_open(inode, file);
}

/* Fills the empty buffer with the next row; false where there is none. */
static bool picture_row(struct picture *picture)
{
	u32 pixels;

	stack_paint();
	pixels = nostray_picture_render(picture->render, picture->buffer, picture->width);
	picture->stack = max(picture->stack, stack_used());
	picture->at = 0;
	picture->length = 3 * pixels;
	sha256_update(&picture->hash, picture->buffer, picture->length);
	return pixels > 0;
}

static void picture_report(struct picture *picture)
{
	u8 digest[SHA256_DIGEST_SIZE];

	sha256_final(&picture->hash, digest);
	pr_info("%s %ux%u sha256 %*phN stack %lu of %lu\n", picture->wide ? "q32" : "q16",
		picture->width, picture->height, SHA256_DIGEST_SIZE, digest, picture->stack,
		THREAD_SIZE);
}

static ssize_t nostray_read(struct file *file, char __user *to, size_t count, loff_t *offset)
{
	struct picture *picture = file->private_data;
	ssize_t given = 0;
	int error = 0;

	if (mutex_lock_interruptible(&picture->lock))
		return -ERESTARTSYS;
	while (given < count) {
		size_t part;

		if (picture->at == picture->length) {
			if (picture->done)
				break;
			if (signal_pending(current)) {
				error = -ERESTARTSYS;
				break;
			}
			cond_resched();
			if (!picture_row(picture)) {
				picture->done = true;
				picture_report(picture);
				break;
			}
		}
		part = min(picture->length - picture->at, count - given);
		if (copy_to_user(to + given, picture->buffer + picture->at, part)) {
			error = -EFAULT;
			break;
		}
		picture->at += part;
		given += part;
	}
	mutex_unlock(&picture->lock);
	return given ? given : error;
}

static int nostray_release(struct inode *inode, struct file *file)
{
	picture_free(file->private_data);
	return 0;
}

static const struct file_operations nostray_operations = {
	.owner = THIS_MODULE,
	.open = nostray_open,
	.read = nostray_read,
	.release = nostray_release,
	.llseek = no_llseek,
};

static struct miscdevice nostray_device = {
	.minor = MISC_DYNAMIC_MINOR,
	.name = "nostray",
	.fops = &nostray_operations,
	.mode = 0444,
};

static int __init nostray_init(void)
{
	/* What an allocation of any size is aligned to at least. */
	if (nostray_picture_align() > ARCH_KMALLOC_MINALIGN) {
		pr_err("a picture must be aligned to %zu bytes\n", nostray_picture_align());
		return -EINVAL;
	}
	return misc_register(&nostray_device);
}

static void __exit nostray_exit(void)
{
	misc_deregister(&nostray_device);
}

module_init(nostray_init);
module_exit(nostray_exit);
MODULE_LICENSE("GPL");
MODULE_DESCRIPTION("A picture rendered in the kernel");
